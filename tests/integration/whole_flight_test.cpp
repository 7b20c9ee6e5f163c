// SPDX-License-Identifier: Apache-2.0
// The whole flight on DDS: the on-board estimator gives estimates from taxi to taxi of an engine that is not built as its
// file says, where the cruise design of the same monitor holds in a part of the cruise only.

#include <gmock/gmock.h>

#include <cmath>

#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class WholeFlightTest : public PairTest {};

TEST_F(WholeFlightTest, HasEstimatesFromTaxiToTaxiThatKnowTheirErrors) {
  const auto monitor = start_monitor({"--estimator-published", "onboard", "--monitor-clock", "source"});
  // two hours in twelve minutes: climbs as fast as the monitor believes, and slams ten times as steep
  const auto simulator =
      start_simulator({"--run-rate", "max"}, file("mission.toml",
                                                  "[mission]\nname = \"two_hours\"\ntime_scale = 0.1\n"
                                                  "[mismatch]\nbuild = true\nsoak = true\nseed = 5\n"));
  constexpr std::size_t sent = 48'000;
  // Lockstep waits for the monitor; this listener may lose some under load, so the monitor's own account counts.
  ASSERT_TRUE(listener_.await(
      [&] {
        return !simulator->running() && !listener_.status.empty() && listener_.status.back().samples_received() == sent;
      },
      seconds(150)))
      << listener_.truth.size() << monitor->log() << simulator->log();
  const MonitorStatus& account = listener_.status.back();
  EXPECT_GE(account.samples_processed(), static_cast<std::uint64_t>(0.99 * sent));
  ASSERT_GT(listener_.health.size(), sent / 2);

  std::size_t judged = 0, covered = 0;
  for (std::size_t k = 4000; k < listener_.health.size(); k += 100) {
    const EngineHealth& h = listener_.health[k];
    const auto found = listener_.truth.find(h.sequence_number());
    if (found == listener_.truth.end()) continue;
    const EngineTruth& truth = found->second;
    for (std::size_t i = 0; i < h.health_count(); ++i) {
      ++judged;
      if (std::abs(h.health()[i] - truth.health()[i]) < 1.96 * h.sigma_total()[i]) ++covered;
    }
  }
  const double coverage = static_cast<double>(covered) / static_cast<double>(judged);
  double claimed = 0.0;
  for (std::size_t i = 0; i < 10; ++i) claimed += 1e4 * std::pow(listener_.health.back().sigma_total()[i], 2);
  std::printf("estimates in %llu of %zu samples, coverage %.3f, SSEE claimed at landing %.2f percent^2\n",
              static_cast<unsigned long long>(account.samples_processed()), sent, coverage, claimed);
  EXPECT_GT(coverage, 0.85);  // one engine, whose errors hang together; fleets: tuner_design study flight
  EXPECT_LT(claimed, 10.0);   // 40 at the start
  EXPECT_FALSE(listener_.has_event(idl::EventKind::operating_point, true));
}

TEST_F(WholeFlightTest, ADesignWithoutAnEngineIsRefusedWithWhatToDo) {
  Process monitor({monitor_program(), "--monitor-design", design_file(), "--estimator-published", "onboard",
                   "--estimator-engine", "rb211", "--check-config"});
  EXPECT_EQ(monitor.wait(seconds(20)), 2);
  EXPECT_THAT(monitor.log(), testing::AllOf(testing::HasSubstr("'estimator.engine'"), testing::HasSubstr("rb211"),
                                            testing::HasSubstr("jt9d")));
}

}  // namespace
