// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine_sim/control/actuator.h"
#include "engine_sim/engines/schedule.h"

namespace {

using namespace ehm::engine_sim;

TEST(Schedule, InterpolatesAndHolds) {
  const Schedule s{{1.0, 10.0}, {2.0, 20.0}, {4.0, 0.0}};
  EXPECT_DOUBLE_EQ(scheduled(s, 0.0), 10.0);
  EXPECT_DOUBLE_EQ(scheduled(s, 1.5), 15.0);
  EXPECT_DOUBLE_EQ(scheduled(s, 2.0), 20.0);
  EXPECT_DOUBLE_EQ(scheduled(s, 3.0), 10.0);
  EXPECT_DOUBLE_EQ(scheduled(s, 9.0), 0.0);
  EXPECT_TRUE(std::isnan(scheduled(s, std::numeric_limits<double>::quiet_NaN())));
}

TEST(Actuator, FollowsTheExactFirstOrderResponse) {
  Actuator a({0.2, 1e9, 1e9}, 0.0);
  for (int k = 0; k < 40; ++k) a.move(1.0, 0.015);
  EXPECT_NEAR(a.position(), 1.0 - std::exp(-40 * 0.015 / 0.2), 1e-12);
}

TEST(Actuator, KeepsItsRatesAndArrivesExactly) {
  Actuator a({0.0, 0.4, 0.1}, 0.0);
  EXPECT_DOUBLE_EQ(a.move(1.0, 0.5), 0.2);
  EXPECT_DOUBLE_EQ(a.move(0.0, 0.5), 0.15);
  for (int k = 0; k < 10; ++k) a.move(0.0, 0.5);
  EXPECT_EQ(a.position(), 0.0);
}

}  // namespace
