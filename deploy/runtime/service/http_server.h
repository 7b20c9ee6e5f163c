// SPDX-License-Identifier: Apache-2.0
#pragma once
// Answers GET requests on one thread of its own; connections are never waited for (http_connection.h). Whatever clients
// do (idle connections, requests a byte at a time, floods, garbage), it costs one thread, `most_connections`
// descriptors and a bounded amount of memory, others are answered meanwhile, and the server stops at once.
//
//   connections   at most `most_connections`; beyond them the one that has been asking for longest is dropped
//   request       its first line only, complete within `ask_limit`, 8 kB with all headers
//   answer        taken by the client within `answer_limit`; while more than `most_bytes` are under way, others wait
//   handlers      what they throw is answered with 500
//
// @throws std::runtime_error if the address cannot be had; the message says why.

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "deploy/runtime/service/listen_address.h"

namespace ehm::service {

struct HttpAnswer {
  int code = 200;
  std::string body;
  const char* content_type = "text/plain; charset=utf-8";
};

class HttpServer {
 public:
  static constexpr std::chrono::milliseconds ask_limit{500};
  static constexpr std::chrono::milliseconds answer_limit{2000};  ///< a thousand engines make 6 MB
  static constexpr std::chrono::milliseconds tick{50};
  static constexpr std::size_t most_connections = 64, most_bytes = 32'000'000;
  using Handler = std::function<HttpAnswer()>;

  explicit HttpServer(const ListenAddress& address);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// Before start(); handlers run on the server's thread and must not wait.
  void on_get(const std::string& path, Handler handler);
  /// Called on the server's thread, every `tick` at least. Before start().
  void on_tick(std::function<void()> call);
  void start();
  int port() const { return port_; }

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
  int port_ = 0;
  std::thread thread_;
};

}  // namespace ehm::service
