// SPDX-License-Identifier: Apache-2.0
// The flight study in small: the same on any number of threads, honest, and what does not fly is named.

#include "tuner_design/flight/flight_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_sim/engines/jt9d_engine.h"

namespace ehm::tuner_design {
namespace {

FlightStudyOptions small() {
  FlightStudyOptions options;
  options.engine = engine_sim::default_engine();
  options.engines = 4;
  options.seed = 31;
  options.mismatch = {true, true, true};
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

}  // namespace
}  // namespace ehm::tuner_design
