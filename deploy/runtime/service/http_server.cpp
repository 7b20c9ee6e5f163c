// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/service/http_server.h"

#include <fcntl.h>
#include <httplib.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <exception>
#include <list>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "deploy/runtime/service/http_connection.h"
#include "deploy/runtime/service/memory_stream.h"

namespace ehm::service {

namespace {
constexpr const char* failed = "HTTP/1.1 500 Internal Server Error\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
}

/// The library binds the address, parses requests and routes them; the connections are ours.
class HttpServer::Loop : public httplib::Server {
 public:
  void run() {
    const int listening = svr_sock_;
    fcntl(listening, F_SETFL, fcntl(listening, F_GETFL) | O_NONBLOCK);
    while (!stop_.load(std::memory_order_relaxed)) {
      try {
        turn(listening);
      } catch (const std::exception&) {
        connections_.clear();  // memory is short: everybody may ask again
      }
    }
    connections_.clear();
  }
  ~Loop() override {
    if (const int listening = svr_sock_; listening != INVALID_SOCKET) close(listening);
  }
  void stop_running() { stop_.store(true, std::memory_order_relaxed); }
  std::function<void()> on_tick;

 private:
  using State = HttpConnection::State;
  void turn(int listening) {
    wait(listening);
    accept_all(listening);
    for (HttpConnection& c : connections_) serve(c);
    const auto now = HttpConnection::Clock::now();
    std::erase_if(connections_, [&](const auto& c) { return c.state() == State::over || now > c.end(); });
    if (on_tick) on_tick();
  }
  void wait(int listening) {
    // While there is no descriptor for them, those who wait to be accepted must not keep the thread awake.
    const short events = std::exchange(no_descriptor_, false) ? short{0} : short{POLLIN};
    polls_.assign(1, {listening, events, 0});
    for (const HttpConnection& c : connections_)
      if (c.state() != State::asked) polls_.push_back({c.socket(), c.events(), 0});
    poll(polls_.data(), polls_.size(), static_cast<int>(tick.count()));
  }
  void accept_all(int listening) {
    // A turn takes in as many as there is room for at most, so that a flood starves nobody who is in.
    for (std::size_t i = 0; i < most_connections; ++i) {
      const int socket = accept4(listening, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (socket < 0) {
        no_descriptor_ = errno != EAGAIN && errno != EWOULDBLOCK;
        return;
      }
      if (connections_.size() == most_connections) drop_oldest();
      connections_.emplace_back(socket, HttpConnection::Clock::now() + ask_limit);
    }
  }
  /// The one that asks for longest; if all are being answered, the oldest of them.
  void drop_oldest() {
    const auto asks = [](const auto& c) { return c.state() == State::asking; };
    auto oldest = std::find_if(connections_.begin(), connections_.end(), asks);
    connections_.erase(oldest == connections_.end() ? connections_.begin() : oldest);
  }
  void serve(HttpConnection& c) {
    if (c.state() == State::asking) c.receive();
    if (c.state() == State::asked && under_way() < most_bytes)
      c.answer(answer_to(c.request()), HttpConnection::Clock::now() + answer_limit);
    if (c.state() == State::answering) c.send();
  }
  std::size_t under_way() const {
    std::size_t bytes = 0;
    for (const HttpConnection& c : connections_) bytes += c.unsent();
    return bytes;
  }
  std::string answer_to(const std::string& request) {
    try {
      MemoryStream stream(request);
      bool closed = false;
      process_request(stream, true, closed, nullptr);
      return stream.take_answer();
    } catch (const std::exception&) {
      return failed;
    }
  }

  std::atomic<bool> stop_{false};
  std::list<HttpConnection> connections_;  ///< in the order in which they came
  std::vector<pollfd> polls_;
  bool no_descriptor_ = false;  ///< the last accept was refused
};

HttpServer::HttpServer(const ListenAddress& address) : loop_(std::make_unique<Loop>()) {
  // The library's own choice (SO_REUSEPORT) would let two services share one port, each with half of the answers.
  loop_->set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  errno = 0;
  if (address.port == 0)
    port_ = loop_->bind_to_any_port(address.host);
  else
    port_ = loop_->bind_to_port(address.host, address.port) ? address.port : -1;
  if (port_ < 0)
    throw std::runtime_error(errno != 0 ? std::generic_category().message(errno) : "no such address on this host");
}

HttpServer::~HttpServer() {
  if (!thread_.joinable()) return;
  loop_->stop_running();
  thread_.join();
}

void HttpServer::on_get(const std::string& path, Handler handler) {
  loop_->Get(path, [handler = std::move(handler)](const httplib::Request&, httplib::Response& response) {
    HttpAnswer answer = handler();
    response.status = answer.code;
    response.set_content(std::move(answer.body), answer.content_type);
  });
}

void HttpServer::on_tick(std::function<void()> call) {
  loop_->on_tick = std::move(call);
}

void HttpServer::start() {
  thread_ = std::thread([this] { loop_->run(); });
}

}  // namespace ehm::service
