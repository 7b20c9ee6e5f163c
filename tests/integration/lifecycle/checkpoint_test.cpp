// SPDX-License-Identifier: Apache-2.0
// A killed monitor resumes where it was; a checkpoint that does not belong is refused and named.

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class CheckpointTest : public PairTest {
 protected:
  std::unique_ptr<Process> start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> flags{"--checkpoint-directory",    folder_.path(), "--checkpoint-period-s", "0.5",
                                   "--monitor-status-period-s", "0.2"};
    flags.insert(flags.end(), more.begin(), more.end());
    return start_monitor(flags);
  }
  /// Flies until the filter has settled and a checkpoint was written since.
  void settle() {
    ASSERT_TRUE(listener_.await(
        [&] {
          return !listener_.health.empty() && !(listener_.health.back().flags() & idl::estimate_flag::converging);
        },
        seconds(40)));
    const auto written = [&] { return listener_.status.back().checkpoints_written(); };
    const auto before = written();
    ASSERT_TRUE(listener_.await([&] { return written() > before + 1; }));
  }
  const HealthEvent* checkpoint_event(bool raised) const {
    return listener_.find_event(idl::EventKind::checkpoint, raised);
  }
  std::string checkpoint_file() const { return folder_.path("engine_1.json"); }
  TemporaryFolder folder_;
};

TEST_F(CheckpointTest, AKilledMonitorIsBackAtOnceWithinOneSigma) {
  auto monitor = start();
  const auto simulator = start_simulator();
  settle();
  monitor->signal(SIGKILL);
  EXPECT_EQ(monitor->wait(seconds(5)), 128 + SIGKILL);
  listener_.await([] { return false; }, seconds(0));
  const EngineHealth before = listener_.health.back();
  const std::size_t estimates = listener_.health.size();
  monitor = start();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > estimates; }, seconds(10)));
  const EngineHealth& after = listener_.health[estimates];
  ASSERT_GT(after.sequence_number(), before.sequence_number());

  double worst = 0.0;
  for (std::size_t i = 0; i < after.health_count(); ++i)
    worst = std::max(worst, std::abs(after.health()[i] - before.health()[i]) / before.sigma_total()[i]);
  std::printf(
      "kill -9 and resume: %llu samples without a monitor; first estimate %.3f sigma from the last (asked: 1)\n",
      static_cast<unsigned long long>(after.sequence_number() - before.sequence_number() - 1), worst);
  EXPECT_LT(worst, 1.0);
  EXPECT_FALSE(after.flags() & idl::estimate_flag::converging);
  EXPECT_DOUBLE_EQ(after.sigma_total()[0], before.sigma_total()[0]);  // as settled as before
  ASSERT_TRUE(listener_.await([&] { return checkpoint_event(false) != nullptr; }));
  const std::string message = checkpoint_event(false)->message().c_str();
  EXPECT_NE(message.find("resumed from its checkpoint"), std::string::npos) << message;
}

TEST_F(CheckpointTest, WithoutOneItStartsCold) {  // the negative of the test above
  auto monitor = start();
  const auto simulator = start_simulator();
  const auto written = [&] { return !listener_.status.empty() && listener_.status.back().checkpoints_written() > 1; };
  ASSERT_TRUE(listener_.await(written));
  monitor->signal(SIGKILL);
  monitor->wait(seconds(5));
  std::filesystem::remove(checkpoint_file());
  const std::size_t estimates = listener_.health.size();
  monitor = start();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > estimates + 100; }));
  EXPECT_TRUE(listener_.health.back().flags() & idl::estimate_flag::converging);
  EXPECT_EQ(checkpoint_event(false), nullptr);
  EXPECT_EQ(checkpoint_event(true), nullptr);
}

TEST_F(CheckpointTest, ADamagedOneIsNamedAndTheMonitorFlies) {
  folder_.file("engine_1.json", "{\"schema\": \"ehm-checkpoint/1\", \"hash\"");
  folder_.file("engine_2.json", std::string(100, '\0'));
  const auto monitor = start();
  const auto simulator = start_simulator();
  const auto refused = [&](std::uint32_t engine, const std::string& file) {
    return std::any_of(listener_.events.begin(), listener_.events.end(), [&](const HealthEvent& e) {
      return e.kind() == static_cast<std::uint32_t>(idl::EventKind::checkpoint) && e.raised() != 0 &&
             e.engine_id() == engine && std::string(e.message().c_str()).find(file) != std::string::npos;
    });
  };
  ASSERT_TRUE(listener_.await([&] { return refused(1, "engine_1.json") && refused(2, "engine_2.json"); }));
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 10; }));
  EXPECT_TRUE(listener_.health.front().flags() & idl::estimate_flag::converging);
}

TEST_F(CheckpointTest, AnotherFlightOfTheSourceIsNotResumed) {
  auto monitor = start();
  {
    const auto simulator = start_simulator();
    ASSERT_TRUE(listener_.await(
        [&] { return !listener_.status.empty() && listener_.status.back().checkpoints_written() > 1; }));
    monitor->signal(SIGTERM);
    EXPECT_EQ(monitor->wait(seconds(5)), 0);
  }
  monitor = start();
  const auto simulator = start_simulator();  // its sequence starts anew
  ASSERT_TRUE(listener_.await([&] { return checkpoint_event(true) != nullptr; }));
  const std::string message = checkpoint_event(true)->message().c_str();
  EXPECT_NE(message.find("the source started anew after the checkpoint"), std::string::npos) << message;
}

TEST_F(CheckpointTest, AFolderThatIsNotThereIsMadeOnceThereIsRoom) {
  const std::string folder = folder_.path("absent");
  const auto check = start_monitor({"--checkpoint-directory", folder, "--check-config"});
  EXPECT_EQ(check->wait(seconds(10)), 2);
  EXPECT_NE(check->log().find(folder), std::string::npos) << check->log();

  std::ofstream(folder) << "in the way";
  const auto monitor = start_monitor(
      {"--checkpoint-directory", folder, "--checkpoint-period-s", "1", "--monitor-status-period-s", "0.1"});
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] {
    return !listener_.status.empty() && listener_.status.back().checkpoints_failed() > 0;
  })) << monitor->log();
  ASSERT_NE(checkpoint_event(true), nullptr);
  EXPECT_NE(std::string(checkpoint_event(true)->message().c_str()).find(folder), std::string::npos);
  std::filesystem::remove(folder);
  EXPECT_TRUE(listener_.await([&] { return listener_.status.back().checkpoints_written() > 0; })) << monitor->log();
  EXPECT_TRUE(listener_.await([&] { return checkpoint_event(false) != nullptr; }));
}

}  // namespace
