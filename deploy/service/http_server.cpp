#include "deploy/service/http_server.h"

#include <httplib.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "deploy/service/deadline_stream.h"

namespace ehm::service {

namespace {

/// Work is done where the connection is accepted: there is one thread.
class Inline : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> work) override { work(); }
  void shutdown() override {}
};

}  // namespace

class HttpServer::Listener : public httplib::Server {
 public:
  std::atomic<bool> stopping{false};

 private:
  bool process_and_close_socket(socket_t socket) override {
    DeadlineStream stream(socket, ask_limit, answer_limit, stopping);
    bool closed = false;
    constexpr bool close_after_this = true;  // a connection that is kept alive would keep the others out
    const bool answered = process_request(stream, close_after_this, closed, nullptr);
    shutdown(socket, SHUT_RDWR);
    close(socket);
    return answered;
  }
};

HttpServer::HttpServer(const ListenAddress& address) : listener_(std::make_unique<Listener>()) {
  listener_->new_task_queue = [] { return new Inline; };
  listener_->set_payload_max_length(1024);
  // The library's own choice (SO_REUSEPORT) would let two services share one port, each with half of the answers.
  listener_->set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  errno = 0;
  if (address.port == 0)
    port_ = listener_->bind_to_any_port(address.host);
  else
    port_ = listener_->bind_to_port(address.host, address.port) ? address.port : -1;
  if (port_ < 0)
    throw std::runtime_error(errno != 0 ? std::generic_category().message(errno) : "no such address on this host");
}

HttpServer::~HttpServer() {
  if (!thread_.joinable()) return;
  listener_->stopping = true;
  listener_->stop();
  thread_.join();
}

void HttpServer::on_get(const std::string& path, Handler handler) {
  listener_->Get(path, [handler = std::move(handler)](const httplib::Request&, httplib::Response& response) {
    const HttpAnswer answer = handler();
    response.status = answer.code;
    response.set_content(answer.body, answer.content_type);
  });
}

void HttpServer::start() {
  thread_ = std::thread([this] { listener_->listen_after_bind(); });
  // A stop before it listens would be lost.
  while (!listener_->is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace ehm::service
