// SPDX-License-Identifier: Apache-2.0
// A process that is stopped for longer than the lease of its participant (Ctrl-Z, a debugger, a suspended machine) is
// dropped by the others; when it goes on, it joins anew, and samples and estimates flow again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>

#include "tests/integration/pair/pair.h"

namespace ehm::test {
namespace {

class HoldTest : public PairTest {
 protected:
  /// Stops it until the listener, which counts such as it by `known`, has dropped it.
  void hold(Process& process, int (Listener::*known)() const) {
    const int before = (listener_.*known)();
    process.signal(SIGSTOP);
    ASSERT_TRUE(listener_.await([&] { return (listener_.*known)() < before; }));
    process.signal(SIGCONT);
  }
  bool estimates_flow() {
    const std::size_t estimates = listener_.health.size();
    return listener_.await([&] { return listener_.health.size() > estimates + 200; }, seconds(10));
  }
};

TEST_F(HoldTest, AMonitorThatWasStoppedForLongerThanTheLeaseJoinsAnew) {
  const auto monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 50; }));
  hold(*monitor, &Listener::monitors);
  EXPECT_TRUE(estimates_flow()) << monitor->log();
  EXPECT_THAT(monitor->log(), testing::HasSubstr("held up for"));
  EXPECT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::held_up, false); }));
  monitor->signal(SIGTERM);
  EXPECT_EQ(monitor->wait(seconds(5)), 0) << monitor->log();
}

TEST_F(HoldTest, ASimulatorThatWasStoppedForLongerThanTheLeaseFliesOn) {
  const auto monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 50; }));
  const std::uint64_t last = listener_.health.back().sequence_number();
  hold(*simulator, &Listener::sources);
  EXPECT_TRUE(estimates_flow()) << simulator->log();
  EXPECT_THAT(simulator->log(), testing::HasSubstr("held up for"));
  EXPECT_GT(listener_.health.back().sequence_number(), last);  // the same flight, not another one
  EXPECT_LT(listener_.health.back().sequence_number(), last + 2000);
  simulator->signal(SIGINT);
  EXPECT_EQ(simulator->wait(seconds(5)), 0) << simulator->log();
}

}  // namespace
}  // namespace ehm::test
