// SPDX-License-Identifier: Apache-2.0
// Wear by the published table, a pace of one's own, and what maintenance gives back.

#include "engine_sim/scenario/life.h"

#include <gtest/gtest.h>

namespace ehm::engine_sim {
namespace {

// Chatterjee & Litt, percent of nominal: fan efficiency -0.18 / -1.5 / -2.85, HPT flow +0.08 / +1.76 / +2.57.
TEST(Life, WearsAsTheTableSays) {
  EXPECT_NEAR(health_of({0.0})[fan_efficiency], -0.0018, 1e-12);
  EXPECT_NEAR(health_of({3000.0})[fan_efficiency], -0.0150, 1e-12);
  EXPECT_NEAR(health_of({6000.0})[fan_efficiency], -0.0285, 1e-12);
  EXPECT_NEAR(health_of({1500.0})[hpt_flow], 0.5 * (0.0008 + 0.0176), 1e-12);
  EXPECT_NEAR(health_of({9000.0})[lpc_flow], -0.0400, 1e-12);
}

TEST(Life, AWashingGivesBackHalfOfWhatTheCompressorsLost) {
  const double before = health_of({2000.0})[fan_flow], fresh = health_of({0.0})[fan_flow];
  EXPECT_NEAR(health_of({2000.0, 2000.0})[fan_flow], 0.5 * (before + fresh), 1e-12);
  EXPECT_EQ(health_of({2000.0, 2000.0})[hpt_efficiency], health_of({2000.0})[hpt_efficiency]);
  EXPECT_LT(health_of({3000.0, 2000.0})[fan_flow], health_of({2000.0, 2000.0})[fan_flow]);
  EXPECT_EQ(health_of({1999.0, 2000.0})[fan_flow], health_of({1999.0})[fan_flow]) << "not washed yet";
}

TEST(Life, ReplacedTurbinesAreNew) {
  EXPECT_EQ(health_of({2500.0, 0.0, 2500.0})[hpt_efficiency], health_of({0.0})[hpt_efficiency]);
  EXPECT_EQ(health_of({2500.0, 0.0, 2500.0})[hpc_flow], health_of({2500.0})[hpc_flow]);
}

TEST(Life, AnEngineOfAFleetHasAPaceOfItsOwn) {
  const HealthVector one = drawn_pace(3), same = drawn_pace(3), other = drawn_pace(4);
  EXPECT_EQ(one, same);
  EXPECT_NE(one, other);
  Life life{3000.0};
  life.pace = one;
  EXPECT_NEAR(health_of(life)[hpc_flow], one[hpc_flow] * -0.025, 1e-12);
}

}  // namespace
}  // namespace ehm::engine_sim
