// SPDX-License-Identifier: Apache-2.0
// Datagrams of the secured domain are recorded off the wire and sent again, as they were and with bits flipped. No
// sample of them counts, and the service goes on.

#include <csignal>
#include <cstdlib>
#include <random>

#include "tests/integration/security/datagrams.h"
#include "tests/integration/security/secured_pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class TrafficTest : public SecuredPair {
 protected:
  /// What protected user data looks like: a secure prefix submessage (0x31) somewhere in an RTPS message.
  static bool is_rtps(const Datagram& d) {
    return d.bytes.size() > 20 && std::equal(d.bytes.begin(), d.bytes.begin() + 4, "RTPS");
  }
  std::vector<Datagram> record_flight() {
    const DatagramRecorder recorder(domain_);
    if (!recorder.works()) return {};
    start_all();
    EXPECT_TRUE(goes_on(150));
    return recorder.recorded();
  }
  /// Every sample that the simulator sent was received once, and no other.
  void expect_only_own_samples() {
    const auto& last = viewer_->status.back();
    EXPECT_EQ(last.samples_received(), last.last_sequence() + 1);
    EXPECT_EQ(last.samples_lost() + last.samples_duplicated() + last.samples_reordered() + last.samples_foreign() +
                  last.samples_malformed() + last.filter_restarts() + last.unknown_engine_samples(),
              0u);
    std::uint64_t next = 0;
    for (const auto& h : viewer_->health) {
      EXPECT_GE(h.sequence_number(), next);
      next = h.sequence_number() + 1;
    }
  }
};

TEST_F(TrafficTest, ReplayedInTheSameSession) {
  const auto traffic = record_flight();
  if (traffic.empty()) GTEST_SKIP() << "packet sockets are not permitted here";
  ASSERT_GT(traffic.size(), 300u);
  const DatagramSender sender;
  for (const auto& datagram : traffic) sender.send(datagram);
  EXPECT_TRUE(goes_on(100)) << monitor_->log();
  expect_only_own_samples();
}

TEST_F(TrafficTest, ReplayedToAMonitorThatWasRestarted) {
  const auto traffic = record_flight();
  if (traffic.empty()) GTEST_SKIP() << "packet sockets are not permitted here";
  simulator_->signal(SIGTERM);
  EXPECT_EQ(simulator_->wait(seconds(10)), 0);
  monitor_ = start_monitor();
  viewer_ = std::make_unique<Viewer>(options("viewer", identity("viewer")));
  const DatagramSender sender;
  // Nobody flies: whatever the monitor receives now comes from the replay.
  EXPECT_FALSE(viewer_->await(
      [&] {
        for (std::size_t i = 0; i < traffic.size(); i += 3) sender.send(traffic[i]);
        return !viewer_->status.empty() || !viewer_->health.empty();
      },
      seconds(4)));
  EXPECT_TRUE(monitor_->running());
  simulator_ = start_simulator();
  EXPECT_TRUE(goes_on(100)) << monitor_->log();
  expect_only_own_samples();
}

TEST_F(TrafficTest, WithFlippedBits) {
  const auto traffic = record_flight();
  if (traffic.empty()) GTEST_SKIP() << "packet sockets are not permitted here";
  const DatagramSender sender;
  const char* seed = std::getenv("EHM_FLIP_SEED");
  std::mt19937 random(seed ? static_cast<unsigned>(std::atoi(seed)) : 5u);
  for (auto datagram : traffic) {
    if (!is_rtps(datagram)) continue;
    for (int flips = 1 + static_cast<int>(random() % 3); flips > 0; --flips)
      datagram.bytes[20 + random() % (datagram.bytes.size() - 20)] ^= static_cast<std::uint8_t>(1u << (random() % 8));
    sender.send(datagram);
  }
  EXPECT_TRUE(goes_on(100)) << monitor_->log();
  expect_only_own_samples();
}

}  // namespace
