// SPDX-License-Identifier: Apache-2.0
// The whole flight on DDS: the on-board estimator gives estimates from taxi to taxi of an engine that is not built as
// its file says, where the cruise design of the same monitor holds in a part of the cruise only.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class WholeFlightTest : public PairTest {
 protected:
  /// Two hours in twelve minutes: climbs as fast as the monitor believes, and slams ten times as steep.
  std::string mission() {
    return file("mission.toml",
                "[mission]\nname = \"two_hours\"\ntime_scale = 0.1\n"
                "[mismatch]\nbuild = true\nsoak = true\nseed = 5\n");
  }
};

constexpr std::size_t sent = 48'000;

TEST_F(WholeFlightTest, HasEstimatesFromTaxiToTaxiThatKnowTheirErrors) {
  const auto monitor = start_monitor({"--estimator-published", "onboard", "--monitor-clock", "source"});
  const auto simulator = start_simulator({"--run-rate", "max"}, mission());
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

// Without an engine on board: point models over the envelope, of one design file.
TEST_F(WholeFlightTest, AScheduleOfPointsHasEstimatesFromTaxiToTaxiToo) {
  const TemporaryFolder folder;
  const std::string design = folder.path("envelope.json");
  Process bench({EHM_TUNER_DESIGN, "envelope", "--nodes", "400", "--quiet", "--out", design});
  ASSERT_EQ(bench.wait(seconds(120)), 0) << bench.log();
  const auto monitor =
      start_monitor({"--estimator-published", "scheduled", "--monitor-clock", "source", "--monitor-design", design});
  const auto simulator = start_simulator({"--run-rate", "max"},
                                         file("mission.toml", "[mission]\nname = \"two_hours\"\ntime_scale = 0.1\n"));
  ASSERT_TRUE(listener_.await(
      [&] {
        return !simulator->running() && !listener_.status.empty() && listener_.status.back().samples_received() == sent;
      },
      seconds(150)))
      << monitor->log() << simulator->log();
  EXPECT_GE(listener_.status.back().samples_processed(), static_cast<std::uint64_t>(0.99 * sent)) << monitor->log();
  std::size_t judged = 0, covered = 0;
  for (std::size_t k = 4000; k < listener_.health.size(); k += 100) {
    const EngineHealth& h = listener_.health[k];
    const auto truth = listener_.truth.find(h.sequence_number());
    if (truth == listener_.truth.end()) continue;
    for (std::size_t i = 0; i < h.health_count(); ++i) {
      ++judged;
      covered += std::abs(h.health()[i] - truth->second.health()[i]) < 1.96 * h.sigma_total()[i];
    }
  }
  std::printf("coverage %.3f\n", static_cast<double>(covered) / static_cast<double>(judged));
  EXPECT_GT(covered, judged * 8 / 10);
  EXPECT_FALSE(listener_.has_event(idl::EventKind::operating_point, true));
}

// The next flight of an engine starts from what the one before has taught, in another process of the monitor.
TEST_F(WholeFlightTest, IsSummedUpAtLandingAndTeachesTheNextOne) {
  const TemporaryFolder folder;
  const std::string& history = folder.path();
  idl::Reader<FlightSummary> summaries(participant_);
  std::vector<FlightSummary> heard;
  std::vector<double> claimed;  // a second after the start of each flight, percent^2
  for (int flight = 0; flight < 2; ++flight) {
    const auto monitor = start_monitor(
        {"--estimator-published", "onboard", "--monitor-clock", "source", "--history-directory", history});
    listener_.health.clear();
    const auto simulator = start_simulator({"--run-rate", "max", "--run-wait-for-monitors", "1"}, mission());
    FlightSummary summary;
    ASSERT_TRUE(listener_.await(
        [&] {
          while (summaries.take(summary)) heard.push_back(summary);
          return heard.size() > static_cast<std::size_t>(flight);
        },
        seconds(150)))
        << monitor->log() << simulator->log();
    ASSERT_GT(listener_.health.size(), 1000u);
    double sum = 0.0;
    for (std::size_t i = 0; i < 10; ++i) sum += 1e4 * std::pow(listener_.health[66].sigma_total()[i], 2);
    claimed.push_back(sum);
    monitor->signal(SIGTERM);
    EXPECT_EQ(monitor->wait(seconds(20)), 0) << monitor->log();
  }
  const FlightSummary& first = heard[0];
  EXPECT_EQ(first.flight(), 1u);
  EXPECT_EQ(heard[1].flight(), 2u);
  EXPECT_EQ(heard[1].flights_learned(), 2u);
  EXPECT_EQ(first.margins_known(), 1u);
  EXPECT_GT(first.egt_margin_k(), 20.0);
  EXPECT_LT(first.egt_margin_k(), 150.0);
  EXPECT_LT(heard[1].egt_margin_sigma_k(), first.egt_margin_sigma_k());
  EXPECT_NEAR(heard[1].egt_margin_k(), first.egt_margin_k(), 4.0 * first.egt_margin_sigma_k());
  double flown_s = 0.0;
  for (std::size_t phase = 2; phase < 8; ++phase) flown_s += first.phase_s()[phase];
  EXPECT_NEAR(flown_s, 0.015 * static_cast<double>(first.samples_accepted()), 1.0);
  EXPECT_NEAR(flown_s, 0.1 * (6918.0 - 415.0), 3.0);  // engine_sim/scenario/mission.cpp
  EXPECT_GE(first.samples_estimated(), first.samples_accepted() * 99 / 100);
  std::printf(
      "claimed a second after the start: %.1f percent^2, in the second flight %.1f; EGT margin %.1f +- %.1f K\n",
      claimed[0], claimed[1], first.egt_margin_k(), first.egt_margin_sigma_k());
  EXPECT_LT(claimed[1], 0.5 * claimed[0]);
  // The truth tells how the engine differs from its file.
  ASSERT_FALSE(listener_.truth.empty());
  EXPECT_EQ(listener_.truth.begin()->second.mismatch_count(), 15u);
  EXPECT_NE(listener_.truth.begin()->second.mismatch()[0], 0.0);

  Process question({monitor_program(), "history", "1", "--directory", history});
  EXPECT_EQ(question.wait(seconds(20)), 0) << question.log();
}

TEST_F(WholeFlightTest, DamagedFilesOfTheHistoryAreNamedEachForItself) {
  const TemporaryFolder folder;
  const std::string baseline = folder.file("engine_1_baseline.json", "{\"schema\": \"ehm-baseline/1\"}\n");
  const std::string flights = folder.file("engine_2_flights.jsonl", "no flight\n\n");
  const auto monitor = start_monitor({"--estimator-published", "onboard", "--history-directory", folder.path()});
  const auto named = [&](std::uint32_t engine, const std::string& file) {
    return std::any_of(listener_.events.begin(), listener_.events.end(), [&](const HealthEvent& e) {
      return e.kind() == static_cast<std::uint32_t>(idl::EventKind::flight_history) && e.raised() != 0 &&
             e.engine_id() == engine && std::string(e.message().c_str()).find(file) != std::string::npos;
    });
  };
  EXPECT_TRUE(listener_.await([&] { return named(1, baseline) && named(2, flights + ":1"); })) << monitor->log();
  EXPECT_TRUE(monitor->running());
}

TEST_F(WholeFlightTest, ADesignWithoutAnEngineIsRefusedWithWhatToDo) {
  Process monitor({monitor_program(), "--monitor-design", design_file(), "--estimator-published", "onboard",
                   "--estimator-engine", "rb211", "--check-config"});
  EXPECT_EQ(monitor.wait(seconds(20)), 2);
  EXPECT_THAT(monitor.log(), testing::AllOf(testing::HasSubstr("'estimator.engine'"), testing::HasSubstr("rb211"),
                                            testing::HasSubstr("jt9d")));
}

}  // namespace
