// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/security/datagrams.h"

#include <arpa/inet.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <netinet/ip.h>
#include <netinet/udp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>

namespace ehm::test {

namespace {

// Well-known ports of RTPS 2.2, chapter 9.6.1.1: a domain has 250 from here on.
constexpr int port_base = 7400, ports_a_domain = 250;

}  // namespace

DatagramRecorder::DatagramRecorder(std::uint32_t domain)
    : socket_(socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(ETH_P_IP))),
      first_port_(static_cast<std::uint16_t>(port_base + ports_a_domain * static_cast<int>(domain))) {
  if (!works()) return;
  sockaddr_ll loopback{};
  loopback.sll_family = AF_PACKET;
  loopback.sll_protocol = htons(ETH_P_IP);
  loopback.sll_ifindex = static_cast<int>(if_nametoindex("lo"));
  bind(socket_, reinterpret_cast<sockaddr*>(&loopback), sizeof loopback);
  thread_ = std::thread([this] { run(); });
}

DatagramRecorder::~DatagramRecorder() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
  if (works()) close(socket_);
}

std::vector<Datagram> DatagramRecorder::recorded() const {
  const std::lock_guard lock(mutex_);
  return recorded_;
}

void DatagramRecorder::run() {
  std::array<std::uint8_t, 65536> packet{};
  while (!stop_.load()) {
    pollfd readable{socket_, POLLIN, 0};
    if (poll(&readable, 1, 50) != 1) continue;
    sockaddr_ll from{};
    socklen_t from_size = sizeof from;
    const ssize_t size =
        recvfrom(socket_, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&from), &from_size);
    if (from.sll_pkttype == PACKET_OUTGOING) continue;  // loopback shows everything twice
    iphdr ip{};
    udphdr udp{};
    if (size < static_cast<ssize_t>(sizeof ip)) continue;
    std::memcpy(&ip, packet.data(), sizeof ip);
    const std::size_t header = 4u * ip.ihl;
    if (ip.protocol != IPPROTO_UDP || static_cast<std::size_t>(size) < header + sizeof udp) continue;
    std::memcpy(&udp, packet.data() + header, sizeof udp);
    if (ntohs(udp.dest) < first_port_ || ntohs(udp.dest) >= first_port_ + ports_a_domain) continue;
    Datagram datagram;
    datagram.to = {};
    datagram.to.sin_family = AF_INET;
    datagram.to.sin_addr.s_addr = ip.daddr;
    datagram.to.sin_port = udp.dest;
    datagram.bytes.assign(packet.data() + header + sizeof udp, packet.data() + size);
    const std::lock_guard lock(mutex_);
    recorded_.push_back(std::move(datagram));
  }
}

DatagramSender::DatagramSender() : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  const in_addr loopback{htonl(INADDR_LOOPBACK)};
  setsockopt(socket_, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback);
}

DatagramSender::~DatagramSender() {
  close(socket_);
}

void DatagramSender::send(const Datagram& datagram) const {
  sendto(socket_, datagram.bytes.data(), datagram.bytes.size(), 0, reinterpret_cast<const sockaddr*>(&datagram.to),
         sizeof datagram.to);
}

}  // namespace ehm::test
