// SPDX-License-Identifier: Apache-2.0
// A bad network between source and monitor: loss, jitter, bursts, duplicates, overtaking, clocks that jump.
// What the monitor does in each case: deploy/docs/wire_behaviour.md.

#include <fcntl.h>
#include <unistd.h>

#include <cmath>

#include "tests/integration/pair/impaired.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class NetworkTest : public ImpairedTest {
 protected:
  /// Largest |estimate - truth| over the published sigma, over all channels and estimates from `from_s` on.
  double worst_deviation(double from_s) const {
    double worst = 0.0;
    for (const auto& h : listener_.health) {
      const auto truth = source_listener_.truth.find(h.sequence_number());
      if (truth == source_listener_.truth.end() || 0.015 * static_cast<double>(h.sequence_number()) < from_s) continue;
      for (std::size_t i = 0; i < h.health_count(); ++i)
        worst = std::max(worst, std::abs(h.health()[i] - truth->second.health()[i]) / h.sigma_total()[i]);
    }
    return worst;
  }
};

TEST_F(NetworkTest, AFifthLostAndFiftyMillisecondsOfJitter) {
  fly(9.0, {"--loss", "0.2", "--jitter-ms", "50", "--seed", "7"});
  ASSERT_FALSE(HasFatalFailure());
  expect_all_accounted_for();
  // Half of what arrives has been overtaken by later samples; the rest still carries the filter.
  EXPECT_GT(status().samples_processed(), impaired("received") / 4);
  EXPECT_EQ(status().filter_restarts(), 0u);
  EXPECT_EQ(status().samples_withheld(), 0u);
  EXPECT_FALSE(listener_.has_event(idl::EventKind::sensor_fault, true));
  EXPECT_LT(worst_deviation(0.0), 3.0);
  const auto& s = status();
  std::printf(
      "20 %% loss, 50 ms jitter: sent %llu, dropped on the way %llu, received %llu = processed %llu + overtaken %llu; "
      "gaps %llu; worst deviation %.2f sigma\n",
      static_cast<unsigned long long>(impaired("received")), static_cast<unsigned long long>(impaired("dropped")),
      static_cast<unsigned long long>(s.samples_received()), static_cast<unsigned long long>(s.samples_processed()),
      static_cast<unsigned long long>(s.samples_reordered()), static_cast<unsigned long long>(s.samples_lost()),
      worst_deviation(0.0));
}

TEST_F(NetworkTest, BurstsDuplicatesAndOvertaking) {
  fly(6.0, {}, "1 pause 0.6\n2 duplicate 0.3\n3.5 clear 0\n3.5 reorder 0.2\n5 clear 0\n");
  ASSERT_FALSE(HasFatalFailure());
  expect_all_accounted_for();
  EXPECT_GT(status().samples_duplicated(), 0u);
  EXPECT_EQ(status().samples_duplicated(), impaired("duplicated"));
  EXPECT_GT(status().samples_reordered(), 0u);
  EXPECT_EQ(status().samples_lost(), status().samples_reordered());  // none vanished, all that is missing came late
  EXPECT_EQ(status().filter_restarts(), 0u);
  // The pause is said, its end too, and what was held is estimated after it.
  EXPECT_TRUE(listener_.has_event(idl::EventKind::input_lost, true));
  EXPECT_TRUE(listener_.has_event(idl::EventKind::input_lost, false));
  EXPECT_FALSE(listener_.has_event(idl::EventKind::sensor_fault, true));
  EXPECT_LT(worst_deviation(0.0), 3.0);
}

TEST_F(NetworkTest, TheSourcesClockJumps) {
  fly(5.0, {}, "1 clock_offset_s 0.5\n2 clock_offset_s 100\n3.5 clock_offset_s 0\n");
  ASSERT_FALSE(HasFatalFailure());
  expect_all_accounted_for();
  EXPECT_EQ(status().samples_processed(), impaired("received"));  // no jump costs an estimate
  EXPECT_EQ(status().filter_restarts(), 2u);                      // half a second is none, 99.5 s ahead, 100 s back
  EXPECT_FALSE(listener_.has_event(idl::EventKind::sample_time, true));
  const HealthEvent* restart = listener_.find_event(idl::EventKind::filter_restart, true);
  ASSERT_NE(restart, nullptr);
  EXPECT_NEAR(restart->value(), 99.5, 0.5);
}

TEST_F(NetworkTest, OurOwnWallClockJumps) {
  const std::string step_file = file("clock_step", std::string(8, '\0'));
  const auto step = [&](double seconds) {
    const int descriptor = open(step_file.c_str(), O_WRONLY);
    EXPECT_EQ(write(descriptor, &seconds, sizeof seconds), static_cast<ssize_t>(sizeof seconds));
    close(descriptor);
  };
  const Process monitor({"/usr/bin/env", std::string("LD_PRELOAD=") + EHM_CLOCK_STEP_LIBRARY,
                         "EHM_CLOCK_STEP=" + step_file, monitor_program(), "--dds-domain", std::to_string(domain_),
                         "--monitor-design", design_file(), "--monitor-status-period-s", "0.1"});
  const auto simulator = start_simulator({"--run-duration-s", "4.5"});
  const auto heard = [&](std::size_t estimates) {
    return listener_.await([&] { return listener_.health.size() >= estimates; });
  };
  ASSERT_TRUE(heard(100));
  const std::int64_t before_ns = listener_.health.back().publish_time_ns();
  step(3600.0);
  ASSERT_TRUE(heard(200));
  EXPECT_GT(listener_.health.back().publish_time_ns() - before_ns, 3'600'000'000'000);  // the step did reach it
  step(-7200.0);
  ASSERT_TRUE(heard(300));
  ASSERT_TRUE(listener_.await(
      [&] { return listener_.status.back().level() == static_cast<std::uint32_t>(idl::StatusLevel::stale); }));
  EXPECT_EQ(status().samples_processed(), 300u);
  EXPECT_EQ(status().filter_restarts(), 0u);
  // An hour in either direction is neither a latency nor an age. (Minutes of margin: machines pause.)
  EXPECT_LT(status().latency_max_us(), 60e6);
  EXPECT_GE(status().latency_p50_us(), 1.0);
  EXPECT_LT(status().age_s(), 60.0);
}

}  // namespace
