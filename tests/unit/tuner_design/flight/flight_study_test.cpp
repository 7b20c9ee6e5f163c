// SPDX-License-Identifier: Apache-2.0
// The flight study in small: the same on any number of threads, honest, and what does not fly is named.

#include "tuner_design/flight/flight_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_sim/engines/jt9d_engine.h"
#include "tuner_design/flight/margin_study.h"
#include "tuner_design/flight/start_study.h"

namespace ehm::tuner_design {
namespace {

FlightStudyOptions small() {
  FlightStudyOptions options;
  options.engine = engine_sim::default_engine();
  options.engines = 4;
  options.draw.seed = 31;
  options.draw.mismatch = {true, true, true};
  options.threads = 2;
  return options;
}

TEST(FlightStudy, AFleetOfPerturbedEnginesIsEstimatedAllFlightAndHonestly) {
  const FleetResult r = fly_fleet(small());
  EXPECT_EQ(r.flown, 4u);
  EXPECT_GE(r.estimated, 0.99);
  EXPECT_LT(r.ssee_landing, 8.0);      // asked of fleets of 100
  EXPECT_GT(r.health_coverage, 0.85);  // four engines: their errors hang together over a flight
  EXPECT_GT(r.claim_landing / r.ssee_landing, 0.4);

  FlightStudyOptions alone = small();
  alone.threads = 1;
  const FleetResult same = fly_fleet(alone);
  EXPECT_EQ(same.ssee_landing, r.ssee_landing);
  EXPECT_EQ(same.health_coverage_by_channel, r.health_coverage_by_channel);
}

TEST(FlightStudy, AnEngineThatDoesNotFlyIsNamedAndInNoFigure) {
  FlightStudyOptions options = small();
  auto starved = std::make_shared<engine_sim::EngineDefinition>(*options.engine);
  starved->data.core_nozzle.area_m2 *= 0.3;
  options.engine = starved;
  options.engines = 1;
  const FleetResult r = fly_fleet(options);
  EXPECT_EQ(r.flown, 0u);
  ASSERT_EQ(r.failed.size(), 1u);
  EXPECT_THAT(r.failed[0].why, testing::HasSubstr("the engine cannot run"));
}

TEST(FlightStudy, AStepIsFoundNamedAndNoneIsInvented) {
  FlightStudyOptions options = small();
  options.engines = 2;
  options.draw.step = StepOfHealth{2500.0, 2.0};
  const FleetResult r = fly_fleet(options);
  EXPECT_EQ(r.steps.happened, 2u);
  EXPECT_EQ(r.steps.found, 2u);
  EXPECT_LT(r.steps.delay_s, 10.0);
  EXPECT_EQ(r.steps.false_alarms, 0.0);
  EXPECT_LT(r.ssee_landing, 10.0);  // a filter that is deaf to it lands with some 90
}

TEST(FlightStudy, ABiasedSensorIsFoundNamedAndNoneIsInvented) {
  FlightStudyOptions options = small();
  options.engines = 2;
  options.draw.bias = BiasOfSensor{900.0, 5.0};
  const FleetResult r = fly_fleet(options);
  EXPECT_EQ(r.biases.happened, 2u);
  EXPECT_EQ(r.biases.found, 2u);
  EXPECT_EQ(r.biases.named, 2u);
  EXPECT_EQ(r.biases.false_alarms, 0.0);
  EXPECT_EQ(r.steps.false_alarms, 0.0) << "what is a sensor's is no step of health";
}

TEST(StartStudy, TwoHundredMissionsStartAndStayAwayFromStall) {
  StartStudyOptions options;
  options.engine = engine_sim::default_engine();
  options.starts = 200;
  options.seed = 77;
  options.threads = 2;
  const StartStudy study = run_start_study(options);
  EXPECT_TRUE(study.failed.empty());
  for (const double margin : study.least_margin_percent) EXPECT_GT(margin, 0.0);
  options.threads = 1;
  EXPECT_EQ(run_start_study(options).least_margin_percent, study.least_margin_percent);
}

TEST(StartStudy, NamesTheStartsThatFail) {
  StartStudyOptions options;
  auto starved = std::make_shared<engine_sim::EngineDefinition>(*engine_sim::default_engine());
  starved->data.core_nozzle.area_m2 *= 0.3;
  options.engine = starved;
  options.starts = 3;
  const StartStudy study = run_start_study(options);
  ASSERT_FALSE(study.failed.empty());
  EXPECT_LT(study.failed.back().index, 3u);
  EXPECT_THAT(study.failed.front().why, testing::HasSubstr("the engine cannot run"));
}

TEST(MarginStudy, ALifeIsFollowedWithAnHonestMargin) {
  MarginStudyOptions options;
  options.engine = engine_sim::default_engine();
  options.engines = 1;
  options.seed = 5;
  const MarginStudy study = run_margin_study(options);
  EXPECT_TRUE(study.failed.empty());
  ASSERT_EQ(study.by_cycles.size(), static_cast<std::size_t>(flights_of_a_life));
  EXPECT_LT(study.by_cycles.back().truth_k, study.by_cycles.front().truth_k - 10.0);  // it wears
  EXPECT_LT(study.error_rms_k, 5.0);                                                  // asked of a fleet: 2
  EXPECT_GT(study.coverage, 0.5);  // eleven flights of one engine, whose errors hang together
}

}  // namespace
}  // namespace ehm::tuner_design
