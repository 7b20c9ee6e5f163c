// SPDX-License-Identifier: Apache-2.0
// Clients of the HTTP endpoint that mean harm: the cycle does not notice, and the endpoint is well afterwards.

#include <arpa/inet.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "tests/integration/observability/watched_pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

using HostileClientTest = WatchedPairTest;

/// Connections that are never waited for.
class Crowd {
 public:
  explicit Crowd(int port) : port_(port) {}
  ~Crowd() {
    for (const int s : sockets_) close(s);
  }
  void join(const std::string& say) {
    const int s = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port_));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    static_cast<void>(connect(s, reinterpret_cast<sockaddr*>(&to), sizeof to));
    sockets_.push_back(s);
    speak(sockets_.size() - 1, say);
  }
  /// One more byte from everybody.
  void drip() {
    for (std::size_t i = 0; i < sockets_.size(); ++i) speak(i, "x");
  }

 private:
  void speak(std::size_t i, const std::string& words) const {
    static_cast<void>(send(sockets_[i], words.data(), words.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  }
  int port_;
  std::vector<int> sockets_;
};

TEST_F(HostileClientTest, DoesNotDisturbTheCycle) {
  const auto monitor = start_watched_monitor();
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 10 && !listener_.status.empty(); }));
  const double descriptors = scrape().value("process_open_fds");
  {
    Crowd crowd(port_);
    for (int i = 0; i < 25; ++i) {
      crowd.join("");                                            // says nothing
      crowd.join("GET /metrics HTTP/1.1\r\nHost: a\r\nX: ");     // never ends
      crowd.join(std::string("\x16\x03\x01\x02\0\xff\r\n", 8));  // another protocol
      crowd.join("GET /" + std::string(20'000, 'a'));            // too long
    }
    // As long as the crowd stays, samples pass: none is lost or late enough to be stale.
    const std::size_t before = listener_.health.size();
    ASSERT_TRUE(listener_.await([&] {
      crowd.drip();
      return listener_.health.size() > before + 150;
    }));
  }
  for (std::size_t i = 1; i < listener_.health.size(); ++i)
    ASSERT_EQ(listener_.health[i].sequence_number(), listener_.health[i - 1].sequence_number() + 1);
  EXPECT_EQ(listener_.status.back().samples_lost(), 0u);
  EXPECT_FALSE(listener_.has_event(idl::EventKind::input_lost, true));
  ASSERT_TRUE(listener_.await([&] { return get("/health").status == 200; }));
  EXPECT_LE(scrape().value("process_open_fds"), descriptors);  // nothing of the crowd is left
  EXPECT_GT(scrape().value("ehm_samples_processed_total"), 150.0);
}

/// User and system time of a process so far.
double cpu_seconds(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string field;
  double ticks = 0.0;
  for (int i = 1; stat >> field; ++i)  // fields 14 and 15 of proc(5); the name holds no blank
    if (i == 14 || i == 15) ticks += std::stod(field);
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

TEST_F(HostileClientTest, WhoFindsNoDescriptorLeftWaitsAndCostsNothing) {
  const auto monitor = start_watched_monitor();
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 10; }));
  const auto open_now = static_cast<rlim_t>(scrape().value("process_open_fds"));
  const rlimit none{open_now - 1, 4096}, enough{1024, 4096};
  ASSERT_EQ(prlimit(monitor->pid(), RLIMIT_NOFILE, &none, nullptr), 0);
  {
    Crowd crowd(port_);
    for (int i = 0; i < 10; ++i) crowd.join("GET /health HTTP/1.1\r\nHost: a\r\n\r\n");
    const std::size_t before = listener_.health.size();
    const double used_s = cpu_seconds(monitor->pid());
    ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > before + 133; }));  // two seconds
    EXPECT_LT(cpu_seconds(monitor->pid()) - used_s, 1.0) << "a thread that spins takes two";
  }
  ASSERT_EQ(prlimit(monitor->pid(), RLIMIT_NOFILE, &enough, nullptr), 0);
  EXPECT_TRUE(listener_.await([&] { return get("/health").status == 200; }));
}

TEST_F(HostileClientTest, DoesNotHoldUpTheStop) {
  const auto monitor = start_watched_monitor();
  Crowd crowd(port_);
  for (int i = 0; i < 20; ++i) crowd.join("GET /metrics HTTP/1.1\r\nX: ");
  monitor->signal(SIGTERM);
  EXPECT_EQ(monitor->wait(seconds(5)), 0) << monitor->log();
}

}  // namespace
