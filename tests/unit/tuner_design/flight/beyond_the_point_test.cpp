// SPDX-License-Identifier: Apache-2.0
// The data path with the on-board estimator published, on the nonlinear engine: it goes on where the design's point
// ends, and an engine model that has lost its answer is asked again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/numbers/noise_source.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/simulation.h"
#include "idl/wire_values.h"
#include "monitor/cycle/monitor_cycle.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/faults/fault_answer.h"
#include "tuner_design/linearise/linearise.h"

namespace ehm::tuner_design {
namespace {

const engine_sim::FlightCondition cruise{10668.0, 0.8, 0.0};

std::shared_ptr<const design::Design> cruise_design() {
  LineariseOptions options;
  options.flight = cruise;
  options.demand = {engine_sim::DemandKind::t40_k, cruise_t40_k};
  options.method = LineariseMethod::tangent;
  return std::make_shared<const design::Design>(
      design_tuner(linearise(engine_sim::default_engine(), options).model, {}));
}

monitor::CycleOptions published(const std::string& estimator) {
  monitor::CycleOptions options;
  options.estimator.published = estimator;
  return options;
}

/// A worn engine at a constant flight condition, sample by sample through a cycle.
class Flown {
 public:
  Flown(const std::string& estimator, const engine_sim::FlightCondition& flight,
        const std::vector<engine_sim::PlannedChange>& health_changes = {})
      : simulation_(scenario(flight, health_changes)), cycle_(cruise_design(), published(estimator)) {}

  /// True: with estimates. `fuel_factor`: of the fuel flow that is reported.
  bool next(double fuel_factor = 1.0) {
    const double time_s = simulation_.time_s();
    const engine_sim::EngineSample from = simulation_.next_sample();
    monitor::Sample to;
    to_sample(from, time_s, to);
    to.actuator[0] *= fuel_factor;
    to.sensor[biased_] *= bias_ + noise_ * random_.normal();
    EXPECT_TRUE(cycle_.process(to));
    for (const monitor::Event& event : cycle_.events()) {
      if (event.kind == idl::EventKind::health_shift) shifts_.push_back(event);
      if (event.kind == idl::EventKind::sensor_fault) faults_.push_back(event);
    }
    cycle_.clear_events();
    return cycle_.result().estimates;
  }
  /// From now on a sensor reads so many times what it should.
  void bias(std::size_t sensor, double factor) {
    biased_ = sensor;
    bias_ = factor;
  }
  /// From now on a sensor has noise of so much of its reading besides its own.
  void shake(std::size_t sensor, double noise) {
    biased_ = sensor;
    noise_ = noise;
  }
  const std::vector<monitor::Event>& faults() const { return faults_; }
  void fly(const engine_sim::FlightCondition& flight) { simulation_.fly(flight); }
  const monitor::MonitorCycle& cycle() const { return cycle_; }
  /// Events of a health shift so far.
  const std::vector<monitor::Event>& shifts() const { return shifts_; }

 private:
  static engine_sim::Scenario scenario(const engine_sim::FlightCondition& flight,
                                       const std::vector<engine_sim::PlannedChange>& health_changes) {
    engine_sim::Scenario s;
    s.health_changes = health_changes;
    s.flight = flight;
    s.wear[engine_sim::hpc_efficiency].initial = -0.015;
    return s;
  }
  engine_sim::Simulation simulation_;
  monitor::MonitorCycle cycle_;
  std::vector<monitor::Event> shifts_, faults_;
  std::size_t biased_ = 0;
  double bias_ = 1.0, noise_ = 0.0;
  NoiseSource random_{3};
};

int samples(double seconds) {
  return static_cast<int>(std::lround(seconds / 0.015));
}

constexpr engine_sim::FlightCondition elsewhere{8000.0, 0.7, 5.0};

TEST(BeyondThePoint, TheOnBoardEstimatorGoesOnWhereTheTunerFilterIsWithheld) {
  Flown tuner("tuner", elsewhere), onboard("onboard", elsewhere);
  for (int k = 0; k < 200; ++k) {
    EXPECT_FALSE(tuner.next()) << k;
    EXPECT_TRUE(onboard.next()) << k;
  }
  EXPECT_GE(onboard.cycle().result().fused.count(), 6u);  // the gate lets 3 in 10 000 good ones out
  EXPECT_EQ(onboard.cycle().result().flags & idl::estimate_flag::off_design, 0u);
}

TEST(BeyondThePoint, AStepOfHealthIsNamedAndEndsOnceItIsLearned) {
  constexpr double step_s = 150.0;
  constexpr std::uint32_t stepped = 4;
  Flown flown("onboard", elsewhere, {{.time_s = step_s, .channel = stepped, .change = 0.012}});
  for (int k = 0; k < samples(step_s); ++k) flown.next();
  EXPECT_TRUE(flown.shifts().empty());
  for (int k = 0; k < samples(15.0); ++k) EXPECT_TRUE(flown.next()) << k;
  ASSERT_EQ(flown.shifts().size(), 1u);
  EXPECT_TRUE(flown.shifts()[0].raised);
  EXPECT_EQ(flown.shifts()[0].channel, stepped);
  EXPECT_GT(flown.shifts()[0].value, 0.003);  // of 0.012, as far as it was seen when it was found
  EXPECT_LT(flown.shifts()[0].value, 0.016);
  EXPECT_NE(flown.cycle().result().flags & idl::estimate_flag::shifted, 0u);
  for (int k = 0; k < samples(75.0); ++k) flown.next();
  ASSERT_EQ(flown.shifts().size(), 2u);
  EXPECT_FALSE(flown.shifts()[1].raised);
  EXPECT_EQ(flown.cycle().result().flags & idl::estimate_flag::shifted, 0u);
}

// What the watch filter has found and not settled when the engine leaves its point would stand for ever.
TEST(BeyondThePoint, AShiftThatWasFoundAtThePointEndsWhereNobodyLooksAtItAnyMore) {
  constexpr double step_s = 60.0;
  Flown flown("onboard", cruise, {{.time_s = step_s, .channel = 4, .change = -0.02}});
  while (flown.shifts().empty() && flown.cycle().counters().received < 6000) flown.next();
  ASSERT_EQ(flown.shifts().size(), 1u);
  EXPECT_TRUE(flown.shifts()[0].raised);
  flown.fly({cruise.altitude_m - 1000.0, cruise.mach, cruise.delta_isa_k});
  for (int k = 0; k < 20; ++k) flown.next();
  ASSERT_GE(flown.shifts().size(), 2u);
  EXPECT_FALSE(flown.shifts()[1].raised);
  EXPECT_EQ(flown.shifts()[1].channel, flown.shifts()[0].channel);
}

// 1.5 % of T30 is some six sigmas: the gate alone would let a part of it through.
TEST(BeyondThePoint, ABiasedSensorIsNamedLeftOutAndComesBackOnceItIsGood) {
  constexpr std::size_t t30 = 5;
  Flown flown("onboard", elsewhere);
  for (int k = 0; k < samples(150.0); ++k) flown.next();
  ASSERT_TRUE(flown.faults().empty());
  flown.bias(t30, 1.015);
  for (int k = 0; k < samples(20.0); ++k) EXPECT_TRUE(flown.next()) << k;
  ASSERT_EQ(flown.faults().size(), 1u);
  EXPECT_TRUE(flown.faults()[0].raised);
  EXPECT_EQ(flown.faults()[0].channel, t30);
  EXPECT_GT(flown.faults()[0].value, flown.faults()[0].threshold);
  EXPECT_TRUE(flown.shifts().empty());
  for (int k = 0; k < samples(60.0); ++k) flown.next();
  EXPECT_FALSE(flown.cycle().result().fused[t30]) << "it stays out while it is biased";
  EXPECT_EQ(flown.faults().size(), 1u);
  flown.bias(t30, 1.0);
  for (int k = 0; k < samples(60.0); ++k) flown.next();
  EXPECT_TRUE(flown.cycle().result().fused[t30]);
  ASSERT_EQ(flown.faults().size(), 2u);
  EXPECT_FALSE(flown.faults()[1].raised);
}

// Of five sigmas, so that the gate holds every second reading back: what it lets through alone would tell nothing.
TEST(BeyondThePoint, ABiasOfFiveSigmasIsNamedThoughTheGateHoldsHalfOfItBack) {
  const auto& sensors = engine_sim::default_engine()->channels.sensors;
  for (const std::size_t sensor : {std::size_t{2}, std::size_t{5}, std::size_t{6}}) {
    SCOPED_TRACE(sensor);
    Flown flown("onboard", elsewhere);
    for (int k = 0; k < samples(150.0); ++k) flown.next();
    ASSERT_TRUE(flown.faults().empty());
    flown.bias(sensor, 1.0 + 5.0 * 0.01 * sensors[sensor].noise_percent);
    for (int k = 0; k < samples(3.0); ++k) flown.next();
    ASSERT_EQ(flown.faults().size(), 1u);
    EXPECT_TRUE(flown.faults()[0].raised);
    EXPECT_EQ(flown.faults()[0].channel, sensor);
    EXPECT_NE(flown.faults()[0].detail & idl::reject_reason::bias, 0u);
  }
}

TEST(BeyondThePoint, ASensorWhoseNoiseHasGrownIsNamedAndComesBackOnceItIsQuiet) {
  constexpr std::size_t t48 = 6;
  const double sigma = 0.01 * engine_sim::default_engine()->channels.sensors[t48].noise_percent;
  Flown flown("onboard", elsewhere);
  for (int k = 0; k < samples(400.0); ++k) flown.next();  // until it expects little else than noise
  ASSERT_TRUE(flown.faults().empty());
  flown.shake(t48, 4.0 * sigma);
  for (int k = 0; k < samples(2.0); ++k) flown.next();
  ASSERT_EQ(flown.faults().size(), 1u);
  EXPECT_EQ(flown.faults()[0].channel, t48);
  EXPECT_NE(flown.faults()[0].detail & idl::reject_reason::noise, 0u);
  EXPECT_GT(flown.faults()[0].value, flown.faults()[0].threshold);
  for (int k = 0; k < samples(20.0); ++k) flown.next();
  EXPECT_FALSE(flown.cycle().result().fused[t48]);
  EXPECT_EQ(flown.faults().size(), 1u);
  flown.shake(t48, 0.0);
  for (int k = 0; k < samples(20.0); ++k) flown.next();
  EXPECT_TRUE(flown.cycle().result().fused[t48]);
}

TEST(BeyondThePoint, AModelThatHasLostItsAnswerIsAskedAgain) {
  for (const engine_sim::FlightCondition& flight : {elsewhere, cruise}) {
    Flown flown("onboard", flight);
    for (int k = 0; k < 100; ++k) ASSERT_TRUE(flown.next()) << k;
    // a word that stays impossible is believed after a while; then no gas path burns so much fuel
    int withheld = 0;
    for (int k = 0; k < 60; ++k) withheld += flown.next(50.0) ? 0 : 1;
    EXPECT_GT(withheld, 10);
    int estimates = 0;
    for (int k = 0; k < 400; ++k) estimates += flown.next() ? 1 : 0;
    EXPECT_GT(estimates, 300);
  }
}

}  // namespace
}  // namespace ehm::tuner_design
