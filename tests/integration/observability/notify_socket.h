// SPDX-License-Identifier: Apache-2.0
#pragma once
// Plays systemd's end of NOTIFY_SOCKET for the services that are started while it lives.

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace ehm::test {

class NotifySocket {
 public:
  NotifySocket(const std::string& path, std::chrono::microseconds watchdog) : path_(path) {
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    unlink(path.c_str());
    if (bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("no socket " + path);
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
    setenv("WATCHDOG_USEC", std::to_string(watchdog.count()).c_str(), 1);
  }
  ~NotifySocket() {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    close(socket_);
    unlink(path_.c_str());
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// The next message that contains `text`; false when none has come within the limit.
  bool hears(const std::string& text, std::chrono::milliseconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    for (;;) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      pollfd ready{socket_, POLLIN, 0};
      if (left.count() <= 0 || poll(&ready, 1, static_cast<int>(left.count())) != 1) return false;
      char buffer[4096];
      const ssize_t got = recv(socket_, buffer, sizeof buffer, 0);
      if (got > 0) heard_ += std::string(buffer, static_cast<std::size_t>(got)) + "\n";
      if (got > 0 && std::string(buffer, static_cast<std::size_t>(got)).find(text) != std::string::npos) return true;
    }
  }
  /// Everything so far, a message a line.
  const std::string& heard() const { return heard_; }

 private:
  std::string path_, heard_;
  int socket_ = -1;
};

}  // namespace ehm::test
