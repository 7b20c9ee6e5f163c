// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/monitor_cycle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "idl/wire_names.h"
#include "idl/wire_values.h"
#include "tests/unit/monitor/cycle/flight.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
namespace reason = ehm::idl::reject_reason;
namespace flag = ehm::idl::estimate_flag;

constexpr int sensor = 2;  // the one that the faults hit
constexpr int settle = 2000;

class MonitorCycleTest : public testing::Test {
 protected:
  MonitorCycleTest() {
    test::Random random(7);
    flight_.emplace(design_->model, design_->model.health_sigma.cwiseProduct(random.normal_vector(10)), 11);
  }
  /// Flies on; `spoil` may change each sample before the cycle sees it.
  template <class Spoil>
  const CycleResult& fly(int samples, Spoil spoil) {
    for (int i = 0; i < samples; ++i) {
      Sample s = flight_->next();
      spoil(s);
      cycle_.process(s);
      take_events();
    }
    return cycle_.result();
  }
  void take_events() {
    for (const Event& e : cycle_.events()) events_.push_back(e);
    cycle_.clear_events();
  }
  const CycleResult& fly(int samples) {
    return fly(samples, [](Sample&) {});
  }
  int count(idl::EventKind kind, bool raised) const {
    return static_cast<int>(std::count_if(events_.begin(), events_.end(),
                                          [&](const Event& e) { return e.kind == kind && e.raised == raised; }));
  }
  void expect_within_sigmas(double sigmas) {
    for (Eigen::Index i = 0; i < 10; ++i)
      EXPECT_LT(std::abs(cycle_.watch().filter().health()(i) - flight_->health()(i)),
                sigmas * cycle_.watch().error().health_sigma()(i))
          << i;
  }
  double noise(int i) const { return design_->model.sensor_noise_sigma(i); }

  std::shared_ptr<const design::Design> design_ = test::made_up_design();
  std::optional<test::Flight> flight_;
  MonitorCycle cycle_{design_, CycleOptions{}};
  std::vector<Event> events_;
};

TEST_F(MonitorCycleTest, EstimatesAreWithinTheirPublishedSigma) {
  const auto& result = fly(settle);
  EXPECT_TRUE(result.estimates);
  EXPECT_EQ(result.flags, 0u);
  EXPECT_EQ(result.fused.count(), 7u);
  expect_within_sigmas(3.0);
  EXPECT_EQ(cycle_.counters().processed, static_cast<std::uint64_t>(settle));
  EXPECT_TRUE(events_.empty());
}

TEST_F(MonitorCycleTest, IsHonestWhileItConverges) {
  const auto& result = fly(1);
  EXPECT_TRUE(result.flags & flag::converging);
  // After one sample little is known: the sigma is nearly the prior's.
  for (Eigen::Index i = 0; i < 10; ++i)
    EXPECT_NEAR(cycle_.watch().error().health_sigma()(i), design_->model.health_sigma(i),
                0.2 * design_->model.health_sigma(i));
  fly(settle);
  for (Eigen::Index i = 0; i < 10; ++i)
    EXPECT_NEAR(cycle_.watch().error().health_sigma()(i), cycle_.watch().filter().health_sigma_total()(i),
                1e-3 * cycle_.watch().filter().health_sigma_total()(i));
}

TEST_F(MonitorCycleTest, BridgesAFewMissingValues) {
  fly(settle);
  const auto& result = fly(5, [](Sample& s) { s.sensor[sensor] = std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_TRUE(result.estimates);
  EXPECT_TRUE(result.flags & flag::bridging);
  EXPECT_FALSE(result.flags & flag::degraded);
  EXPECT_EQ(result.reason[sensor], reason::not_finite);
  EXPECT_EQ(cycle_.counters().sensor_rejections, 5u);
  expect_within_sigmas(3.0);
}

TEST_F(MonitorCycleTest, AMissingSensorsDesignTakesOverAndGoesAgain) {
  fly(settle);
  const auto& result = fly(300, [](Sample& s) { s.sensor_valid &= ~(1u << sensor); });
  EXPECT_EQ(count(idl::EventKind::sensor_fault, true), 1);
  EXPECT_TRUE(result.flags & flag::degraded);
  EXPECT_FALSE(result.estimate.sensors[sensor]);
  EXPECT_EQ(result.reason[sensor], reason::source_invalid | reason::excluded);
  expect_within_sigmas(3.0);
  fly(settle, [](Sample& s) { s.sensor_valid &= ~(1u << sensor); });
  for (Eigen::Index i = 0; i < 10; ++i) {
    EXPECT_GE(cycle_.watch().error().health_sigma()(i),
              0.999 * cycle_.watch().filter().model().full.health_sigma_total(i))
        << i;
    EXPECT_LE(cycle_.watch().error().health_sigma()(i), 1.001 * design_->model.health_sigma(i)) << i;
  }
  fly(199);
  EXPECT_FALSE(cycle_.result().estimate.sensors[sensor]);
  fly(2);
  EXPECT_TRUE(cycle_.result().estimate.sensors[sensor]);
  EXPECT_EQ(count(idl::EventKind::sensor_fault, false), 1);
  fly(settle);
  expect_within_sigmas(3.0);
}

TEST_F(MonitorCycleTest, ABiasedSensorIsExcludedAndStaysOut) {
  fly(settle);
  fly(3000, [&](Sample& s) { s.sensor[sensor] += 12.0 * noise(sensor); });
  EXPECT_EQ(count(idl::EventKind::sensor_fault, true), 1);
  EXPECT_EQ(count(idl::EventKind::sensor_fault, false), 0);
  EXPECT_FALSE(cycle_.result().estimate.sensors[sensor]);
  EXPECT_TRUE(cycle_.result().reason[sensor] & reason::innovation_gate);
  expect_within_sigmas(3.0);
}

TEST_F(MonitorCycleTest, AnEngineChangeIsFollowedNotRejected) {
  fly(settle);
  Eigen::VectorXd h = flight_->health();
  h(4) -= 0.06;
  flight_->set_health(h);
  fly(settle);
  EXPECT_EQ(cycle_.watch().filter().sensor_set(), estimation::SensorSet::full());
  EXPECT_EQ(count(idl::EventKind::health_shift, true), 1);
  EXPECT_EQ(count(idl::EventKind::sensor_fault, true), 0);
}

TEST_F(MonitorCycleTest, WithTwoSensorsGoneEstimatesAreWithheldAndComeBack) {
  fly(settle);
  const auto& result = fly(50, [](Sample& s) { s.sensor_valid &= ~0b110u; });
  EXPECT_FALSE(result.estimates);
  EXPECT_EQ(count(idl::EventKind::no_design, true), 1);
  EXPECT_GT(cycle_.counters().withheld, 40u);
  fly(250);
  EXPECT_TRUE(cycle_.result().estimates);
  EXPECT_TRUE(cycle_.result().flags & flag::converging);  // from a cold start, and it says so
  EXPECT_EQ(count(idl::EventKind::no_design, false), 1);
  fly(settle);
  expect_within_sigmas(3.0);
}

TEST_F(MonitorCycleTest, OffDesignEstimatesAreWithheld) {
  fly(settle);
  const double trim = design_->model.controls[0].trim;
  const auto& result = fly(10, [&](Sample& s) { s.actuator[0] = 1.2 * trim; });
  EXPECT_FALSE(result.estimates);
  EXPECT_TRUE(result.flags & flag::off_design);
  EXPECT_EQ(result.reason[0] & reason::withheld, reason::withheld);
  EXPECT_EQ(count(idl::EventKind::operating_point, true), 1);
  fly(1);
  EXPECT_TRUE(cycle_.result().estimates);
  EXPECT_EQ(count(idl::EventKind::operating_point, false), 1);
}

TEST_F(MonitorCycleTest, RetiringEndsEveryConditionThatIsRaised) {
  fly(settle);
  const double trim = design_->model.controls[0].trim;
  fly(50, [](Sample& s) { s.sensor_valid &= ~0b110u; });    // too few sensors
  fly(10, [&](Sample& s) { s.actuator[0] = 1.2 * trim; });  // beyond the operating point
  cycle_.no_input(1.0);
  take_events();
  for (const auto kind : {idl::EventKind::operating_point, idl::EventKind::no_design, idl::EventKind::input_lost,
                          idl::EventKind::sensor_fault})
    EXPECT_GT(count(kind, true), count(kind, false)) << static_cast<int>(kind);
  cycle_.retire();
  take_events();
  for (std::uint32_t kind = 1; kind < idl::event_kind_names.size(); ++kind) {
    const auto k = static_cast<idl::EventKind>(kind);
    if (k == idl::EventKind::filter_restart) continue;  // not a condition
    EXPECT_EQ(count(k, true), count(k, false)) << idl::event_kind_names[kind];
  }
}

TEST_F(MonitorCycleTest, LostSamplesAreCountedAndPredictedOver) {
  fly(settle);
  for (int i = 0; i < 20; ++i) flight_->next();
  const auto& result = fly(1);
  EXPECT_TRUE(result.estimates);
  EXPECT_EQ(cycle_.counters().lost, 20u);
  expect_within_sigmas(3.0);
}

TEST_F(MonitorCycleTest, LostSamplesArePredictedStepByStep) {
  // The engine moves after a step of fuel flow. Four samples without a value and four that never came are the same.
  fly(settle);
  MonitorCycle lossy = cycle_;
  flight_->set_actuator(0.03);
  const Sample step = flight_->next();
  cycle_.process(step);
  lossy.process(step);
  fly(4, [](Sample& s) { s.sensor_valid = 0; });
  const Sample next = flight_->next();
  cycle_.process(next);
  lossy.process(next);
  EXPECT_EQ(lossy.counters().lost, 4u);
  EXPECT_TRUE(lossy.result().innovation.isApprox(cycle_.result().innovation, 1e-12));
}

TEST_F(MonitorCycleTest, MalformedDuplicateAndReorderedSamplesChangeNothing) {
  fly(settle);
  const Sample first = flight_->next(), second = flight_->next();
  cycle_.process(first);
  cycle_.process(second);
  const estimation::HealthVector before = cycle_.watch().filter().health();
  cycle_.process(second);
  cycle_.process(first);
  Sample malformed = flight_->next();
  malformed.sensor_count = 3;
  EXPECT_FALSE(cycle_.process(malformed));
  EXPECT_TRUE(cycle_.result().estimates);  // the last good sample still stands
  EXPECT_EQ(cycle_.counters().duplicated, 1u);
  EXPECT_EQ(cycle_.counters().reordered, 1u);
  EXPECT_EQ(cycle_.counters().malformed, 1u);
  EXPECT_EQ(cycle_.watch().filter().health(), before);
}

TEST_F(MonitorCycleTest, ARestartedSourceRestartsTheFilterAndSaysSo) {
  fly(settle);
  test::Flight again(design_->model, flight_->health(), 3);
  Sample s = again.next();
  s.source_time_ns += 1'000'000'000'000;
  cycle_.process(s);
  EXPECT_EQ(cycle_.counters().restarts, 1u);
  ASSERT_EQ(cycle_.events().size(), 1u);
  EXPECT_EQ(cycle_.events().begin()->kind, idl::EventKind::filter_restart);
  EXPECT_TRUE(cycle_.result().flags & flag::converging);
}

TEST_F(MonitorCycleTest, ASensorMissingFromTheStartIsUsedSoonAfterItComes) {
  fly(600, [](Sample& s) { s.sensor_valid &= ~(1u << sensor); });
  EXPECT_FALSE(cycle_.result().estimate.sensors[sensor]);
  fly(210);  // requalification takes 200
  EXPECT_TRUE(cycle_.result().estimate.sensors[sensor]);
}

TEST_F(MonitorCycleTest, ASecondSourceIsNotListenedToUntilTheFirstIsSilent) {
  fly(settle);
  const estimation::HealthVector before = cycle_.watch().filter().health();
  test::Flight other(design_->model, Eigen::VectorXd::Zero(10), 5);
  for (int i = 0; i < 10; ++i) {
    Sample s = other.next();
    s.source_id = 9;
    EXPECT_FALSE(cycle_.process(s));
  }
  EXPECT_EQ(cycle_.counters().foreign, 10u);
  EXPECT_EQ(cycle_.watch().filter().health(), before);
  ASSERT_EQ(cycle_.events().size(), 1u);  // said once
  EXPECT_EQ(cycle_.events().begin()->kind, idl::EventKind::second_source);
  cycle_.no_input(1.0);
  Sample s = other.next();
  s.source_id = 9;
  s.source_time_ns += 1'000'000'000'000;
  EXPECT_TRUE(cycle_.process(s));
}

TEST_F(MonitorCycleTest, AnotherSampleTimeIsNoticedAndEstimatesAreWithheld) {
  fly(200, [](Sample& s) { s.source_time_ns *= 2; });
  EXPECT_FALSE(cycle_.result().estimates);
  EXPECT_EQ(count(idl::EventKind::sample_time, true), 1);
}

TEST_F(MonitorCycleTest, LostInputIsRaisedOnceAndClearedByTheNextSample) {
  fly(10);
  cycle_.no_input(0.044);
  EXPECT_FALSE(cycle_.stale());
  cycle_.no_input(0.046);
  cycle_.no_input(0.061);
  EXPECT_TRUE(cycle_.stale());
  EXPECT_EQ(cycle_.events().size(), 1u);
  cycle_.clear_events();
  fly(1);
  EXPECT_FALSE(cycle_.stale());
  EXPECT_EQ(count(idl::EventKind::input_lost, false), 1);
}

TEST_F(MonitorCycleTest, SameSamplesSameBits) {
  MonitorCycle other(design_, CycleOptions{});
  for (int i = 0; i < 500; ++i) {
    const Sample s = flight_->next();
    cycle_.process(s);
    other.process(s);
  }
  EXPECT_EQ(cycle_.watch().filter().health(), other.watch().filter().health());
  EXPECT_EQ(cycle_.watch().error().health_sigma(), other.watch().error().health_sigma());
}

TEST_F(MonitorCycleTest, AnOperatorsResetReadmitsNoSensorThatWasNamed) {
  const auto biased = [&](Sample& s) { s.sensor[sensor] += 12.0 * noise(sensor); };
  fly(settle);
  fly(600, biased);
  ASSERT_FALSE(cycle_.result().estimate.sensors[sensor]);
  events_.clear();
  cycle_.reset();
  fly(3000, biased);
  EXPECT_EQ(count(idl::EventKind::sensor_fault, false), 0);
  EXPECT_FALSE(cycle_.result().estimate.sensors[sensor]);
  expect_within_sigmas(3.0);
  // Well again it returns, though not before the filter is warm enough to judge it.
  cycle_.reset();
  fly(400);
  EXPECT_FALSE(cycle_.result().estimate.sensors[sensor]);
  fly(3000);
  EXPECT_TRUE(cycle_.result().estimate.sensors[sensor]);
  EXPECT_EQ(count(idl::EventKind::sensor_fault, false), 1);
}

TEST_F(MonitorCycleTest, AGapReadmitsNoSensorThatWasNamed) {
  const auto biased = [&](Sample& s) { s.sensor[sensor] += 12.0 * noise(sensor); };
  fly(settle);
  fly(600, biased);
  for (int i = 0; i < 400; ++i) flight_->next();  // six seconds
  fly(1000, biased);
  EXPECT_EQ(cycle_.counters().restarts, 1u);
  EXPECT_EQ(count(idl::EventKind::sensor_fault, false), 0);
  EXPECT_FALSE(cycle_.result().estimate.sensors[sensor]);
}

TEST_F(MonitorCycleTest, AFrozenSensorWhoseLastBitTogglesIsNamed) {
  fly(settle);
  double held = 0.0;
  fly(300, [&](Sample& s) {
    if (held == 0.0) held = s.sensor[sensor];
    held = s.sensor[sensor] = std::nextafter(held, s.sequence % 2 ? 1e9 : -1e9);
  });
  EXPECT_EQ(count(idl::EventKind::sensor_fault, true), 1);
  EXPECT_FALSE(cycle_.result().estimate.sensors[sensor]);
  EXPECT_TRUE(cycle_.result().reason[sensor] & reason::quiet);
}

TEST_F(MonitorCycleTest, ResetStartsCold) {
  fly(settle);
  cycle_.reset();
  const auto& result = fly(1);
  EXPECT_TRUE(result.flags & flag::converging);
  EXPECT_EQ(cycle_.counters().restarts, 1u);
}

}  // namespace
