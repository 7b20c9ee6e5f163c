// SPDX-License-Identifier: Apache-2.0
// The law by which the engines of the studies wear from flight to flight: through the table, one way only, and aloud about what it lacks.

#include "tuner_design/wear/wear_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/scenario/life.h"

namespace ehm::tuner_design {
namespace {

const std::vector<std::string>& all_names() {
  static const std::vector<std::string> names(engine_sim::health_names.begin(), engine_sim::health_names.end());
  return names;
}

double worn_percent(std::size_t parameter, double cycles) {
  return 100.0 * engine_sim::health_of({.cycles = cycles})[parameter];
}

// Chatterjee & Litt: fan flow -2.04, -3.65 %, HPT flow +1.76, +2.57 %; the run-in is over at 3000 cycles.
TEST(WearLaw, GoesThroughTheTable) {
  const WearLaw law = wear_law({"fan_flow", "hpt_flow"}, 12.0);
  EXPECT_TRUE(law.not_known.empty());
  EXPECT_NEAR(law.at(250.0)(0), -2.04, 0.01);
  EXPECT_NEAR(law.at(500.0)(0), -3.65, 0.01);
  EXPECT_NEAR(law.at(250.0)(1), 1.76, 0.01);
  EXPECT_NEAR(law.at(500.0)(1), 2.57, 0.01);
  EXPECT_EQ(law.direction(0), -1.0);
  EXPECT_EQ(law.direction(1), 1.0);
}

TEST(WearLaw, MeetsTheSimulatorsTableInEveryParameter) {
  const WearLaw law = wear_law(all_names(), 12.0);
  for (std::size_t i = 0; i < all_names().size(); ++i) {
    SCOPED_TRACE(all_names()[i]);
    EXPECT_NEAR(law.at(250.0)(as_index(i)), worn_percent(i, 3000.0), 0.01);
    EXPECT_NEAR(law.at(500.0)(as_index(i)), worn_percent(i, 6000.0), 0.01);
  }
}

TEST(WearLaw, ANewEngineHasNoneAndItOnlyGoesOneWay) {
  const WearLaw law = wear_law(all_names(), 12.0);
  EXPECT_EQ(law.at(0.0), Eigen::VectorXd::Zero(as_index(all_names().size())));
  for (int flight = 1; flight < 500; ++flight)
    EXPECT_GT((law.at(flight) - law.at(flight - 1)).cwiseProduct(law.direction).minCoeff(), 0.0) << flight;
}

TEST(WearLaw, SaysWhatItDoesNotKnow) {
  const WearLaw law = wear_law({"fan_efficiency", "oddity"}, 12.0);
  EXPECT_THAT(law.not_known, testing::ElementsAre("oddity"));
  EXPECT_EQ(law.at(100.0)(0), law.at(100.0)(1));
}

TEST(WearLaw, EqualWearGivesAllParametersTheSameAndKeepsTheirDirections) {
  const WearLaw law = wear_law(all_names(), 12.0, 3.0);
  for (std::size_t i = 0; i < all_names().size(); ++i)
    EXPECT_NEAR(law.at(500.0)(as_index(i)), 3.0 * law.direction(as_index(i)), 0.02) << all_names()[i];
}

}  // namespace
}  // namespace ehm::tuner_design
