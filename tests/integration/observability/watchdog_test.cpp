// SPDX-License-Identifier: Apache-2.0
// systemd's protocol without systemd: readiness, status, watchdog, stop. A hung loop is not fed, though the process
// lives and its other threads run.

#include <gmock/gmock.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "deploy/runtime/service/watchdog.h"
#include "tests/integration/observability/notify_socket.h"
#include "tests/integration/observability/stopped_thread.h"
#include "tests/integration/observability/watched_pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::StartsWith;

constexpr milliseconds watchdog{300}, look{150};  // a loop turns every 15 ms at least; this machine pauses up to 50 ms

class WatchdogTest : public WatchedPairTest {
 protected:
  NotifySocket systemd_{testing::TempDir() + "ehm-notify-" + std::to_string(getpid()), watchdog};

  void expect_fed() {
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(systemd_.hears("WATCHDOG=1", seconds(10))) << systemd_.heard();
  }
  /// The look under way may still feed; after it nothing comes for far longer than systemd would wait.
  void expect_not_fed() {
    systemd_.hears("WATCHDOG=1", 2 * look);
    EXPECT_FALSE(systemd_.hears("WATCHDOG=1", 4 * watchdog)) << systemd_.heard();
  }
};

TEST_F(WatchdogTest, AHungCycleIsNotFed) {
  const auto monitor = start_watched_monitor();
  ASSERT_TRUE(systemd_.hears("READY=1", seconds(20)));
  EXPECT_THAT(systemd_.heard(), StartsWith("READY=1"));  // nothing is said before
  expect_fed();
  try {
    const StoppedThread cycle(monitor->pid());
    expect_not_fed();
    EXPECT_THAT(monitor->log(), HasSubstr("the cycle has not turned"));
    EXPECT_EQ(get("/health").status, 503);  // other threads run: the process has not simply stopped
    EXPECT_THAT(get("/health").body, HasSubstr("the cycle thread has stalled"));
  } catch (const std::runtime_error& e) {
    GTEST_SKIP() << "this system lets no test stop a thread: " << e.what();
  }
  expect_fed();  // it hangs no more
  EXPECT_THAT(monitor->log(), HasSubstr("the cycle turns again"));
  EXPECT_EQ(get("/health").status, 200);
  monitor->signal(SIGTERM);
  EXPECT_TRUE(systemd_.hears("STOPPING=1", seconds(10)));
  EXPECT_EQ(monitor->wait(seconds(10)), 0);
}

TEST_F(WatchdogTest, OneHungLoopOfTwoIsEnough) {
  service::TurnCounter cycle, reporter;
  std::atomic<bool> reporter_turns{true};
  const std::jthread loops([&](const std::stop_token& stop) {
    for (; !stop.stop_requested(); std::this_thread::sleep_for(milliseconds(5))) {
      cycle.turned();
      if (reporter_turns) reporter.turned();
    }
  });
  const service::Watchdog fed({{&cycle, "cycle"}, {&reporter, "reporter"}});
  expect_fed();
  reporter_turns = false;
  expect_not_fed();
  reporter_turns = true;
  expect_fed();
}

TEST_F(WatchdogTest, TheStatusLineFollowsTheEngines) {
  const auto monitor = start_watched_monitor();
  const auto simulator = start_simulator();
  EXPECT_TRUE(systemd_.hears("STATUS=1 engine: 1 OK", seconds(20))) << systemd_.heard();
  simulator->signal(SIGTERM);
  EXPECT_TRUE(systemd_.hears("STATUS=1 engine: 1 STALE", seconds(20))) << systemd_.heard();
}

TEST_F(WatchdogTest, AHungSimulatorIsNotFed) {
  const auto simulator = start_simulator();  // waits for readers: ready, and fed
  ASSERT_TRUE(systemd_.hears("READY=1", seconds(20)));
  expect_fed();
  try {
    const StoppedThread loop(simulator->pid());
    expect_not_fed();
  } catch (const std::runtime_error& e) {
    GTEST_SKIP() << "this system lets no test stop a thread: " << e.what();
  }
  expect_fed();
  simulator->signal(SIGTERM);
  EXPECT_TRUE(systemd_.hears("STOPPING=1", seconds(10)));
  EXPECT_EQ(simulator->wait(seconds(10)), 0);
}

}  // namespace
