#pragma once
// Answers GET requests on one thread of its own, one connection at a time, each within `ask_limit` and `answer_limit`:
// whatever clients do (idle connections, requests a byte at a time, garbage), it costs one thread and one descriptor,
// and the server stops at once. Who connects meanwhile waits in the kernel's queue.
//
// @throws std::runtime_error if the address cannot be had; the message says why.

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "deploy/service/listen_address.h"

namespace ehm::service {

struct HttpAnswer {
  int code = 200;
  std::string body;
  const char* content_type = "text/plain; charset=utf-8";
};

class HttpServer {
 public:
  static constexpr std::chrono::milliseconds ask_limit{500};      ///< until the request is complete
  static constexpr std::chrono::milliseconds answer_limit{2000};  ///< a thousand engines make 6 MB
  using Handler = std::function<HttpAnswer()>;

  explicit HttpServer(const ListenAddress& address);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// Before start(); handlers run on the server's thread.
  void on_get(const std::string& path, Handler handler);
  void start();
  int port() const { return port_; }

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
  int port_ = 0;
  std::thread thread_;
};

}  // namespace ehm::service
