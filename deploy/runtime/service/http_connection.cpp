// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/service/http_connection.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace ehm::service {

namespace {
bool would_block() {
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}
}  // namespace

HttpConnection::~HttpConnection() {
  if (socket_ < 0) return;
  shutdown(socket_, SHUT_RDWR);
  close(socket_);
}

short HttpConnection::events() const {
  return state_ == State::answering ? POLLOUT : POLLIN;
}

void HttpConnection::receive() {
  std::array<char, 2048> buffer;
  const ssize_t got = recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (got < 0 && would_block()) return;
  if (got <= 0) {
    state_ = State::over;
    return;
  }
  text_.append(buffer.data(), static_cast<std::size_t>(got));
  if (text_.find("\r\n\r\n") != std::string::npos)
    state_ = State::asked;
  else if (text_.size() > longest_head)
    answer("HTTP/1.1 431 Request Header Fields Too Large\r\nContent-Length: 0\r\nConnection: close\r\n\r\n", end_);
}

std::string HttpConnection::request() const {
  return text_.substr(0, text_.find("\r\n")) + "\r\nConnection: close\r\n\r\n";
}

void HttpConnection::answer(std::string text, Clock::time_point end) {
  text_ = std::move(text);
  sent_ = 0;
  end_ = end;
  state_ = text_.empty() ? State::over : State::answering;
}

void HttpConnection::send() {
  const ssize_t sent = ::send(socket_, text_.data() + sent_, text_.size() - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
  if (sent < 0 && would_block()) return;
  if (sent < 0 || (sent_ += static_cast<std::size_t>(sent)) == text_.size()) state_ = State::over;
}

}  // namespace ehm::service
