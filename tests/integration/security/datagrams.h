// SPDX-License-Identifier: Apache-2.0
#pragma once
// UDP datagrams of one DDS domain as they pass over loopback, and the way to send them once more.

#include <netinet/in.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace ehm::test {

struct Datagram {
  sockaddr_in to;
  std::vector<std::uint8_t> bytes;
};

/// Records every datagram to a port of the domain while it lives. Needs the right to open packet sockets.
class DatagramRecorder {
 public:
  explicit DatagramRecorder(std::uint32_t domain);
  ~DatagramRecorder();
  /// False where packet sockets are not permitted.
  bool works() const { return socket_ >= 0; }
  std::vector<Datagram> recorded() const;

 private:
  void run();
  int socket_;
  std::uint16_t first_port_;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  std::vector<Datagram> recorded_;
  std::thread thread_;
};

/// Sends datagrams from a port of its own, as any process on the host can.
class DatagramSender {
 public:
  DatagramSender();
  ~DatagramSender();
  void send(const Datagram& datagram) const;

 private:
  int socket_;
};

}  // namespace ehm::test
