#pragma once
// One accepted TCP connection for httplib, on which all reading ends at one absolute time, all writing at another, and
// both at once when the server stops. The library's own limits hold for each read, so a client that sends a byte now
// and then would hold its thread for hours.

#include <httplib.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>

namespace ehm::service {

class DeadlineStream : public httplib::Stream {
 public:
  using Clock = std::chrono::steady_clock;

  DeadlineStream(int socket, std::chrono::milliseconds read_limit, std::chrono::milliseconds write_limit,
                 const std::atomic<bool>& stop)
      : socket_(socket), write_limit_(write_limit), stop_(stop), end_(Clock::now() + read_limit) {}

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
    if (!answering_) end_ = Clock::now() + write_limit_;
    answering_ = true;
    return await(POLLOUT) ? send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT) : -1;
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return socket_; }

 private:
  bool await(short what) const {
    constexpr int look_ms = 20;  // how soon a stop is seen
    pollfd ready{socket_, what, 0};
    while (!stop_ && Clock::now() < end_)
      if (poll(&ready, 1, look_ms) == 1) return true;
    return false;
  }

  int socket_;
  std::chrono::milliseconds write_limit_;
  const std::atomic<bool>& stop_;
  Clock::time_point end_;
  bool answering_ = false;
  std::array<char, 1024> buffer_{};
  std::size_t begin_ = 0, filled_ = 0;
};

}  // namespace ehm::service
