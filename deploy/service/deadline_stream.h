#pragma once
// One accepted TCP connection for httplib, on which all reading and writing together ends at one absolute time. The
// library's own limits hold for each read, so a client that sends a byte now and then would hold its thread for hours.

#include <httplib.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace ehm::service {

class DeadlineStream : public httplib::Stream {
 public:
  DeadlineStream(int socket, std::chrono::milliseconds limit)
      : socket_(socket), end_(std::chrono::steady_clock::now() + limit) {}

  bool is_readable() const override { return begin_ < filled_ || await(POLLIN); }
  bool is_writable() const override { return await(POLLOUT); }
  ssize_t read(char* to, std::size_t size) override {
    if (begin_ == filled_) {
      if (!await(POLLIN)) return -1;
      const ssize_t got = recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
      if (got <= 0) return got;
      begin_ = 0;
      filled_ = static_cast<std::size_t>(got);
    }
    const std::size_t count = std::min(size, filled_ - begin_);
    std::copy_n(buffer_.data() + begin_, count, to);
    begin_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, std::size_t size) override {
    return await(POLLOUT) ? send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT) : -1;
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return socket_; }

 private:
  bool await(short what) const {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - std::chrono::steady_clock::now());
    pollfd ready{socket_, what, 0};
    return left.count() > 0 && poll(&ready, 1, static_cast<int>(left.count())) == 1;
  }

  int socket_;
  std::chrono::steady_clock::time_point end_;
  std::array<char, 1024> buffer_{};
  std::size_t begin_ = 0, filled_ = 0;
};

}  // namespace ehm::service
