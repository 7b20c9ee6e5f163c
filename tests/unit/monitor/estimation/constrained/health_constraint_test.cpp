// SPDX-License-Identifier: Apache-2.0
// No parameter improves, whichever way wear takes it, until maintenance.

#include "monitor/estimation/constrained/health_constraint.h"

#include <gtest/gtest.h>

namespace ehm::estimation {
namespace {

// Signs of Chatterjee & Litt's table of wear, NASA/TM-2003-212607.
static_assert(wear_direction("fan_efficiency") < 0.0);
static_assert(wear_direction("hpc_flow") < 0.0);
static_assert(wear_direction("hpt_efficiency") < 0.0);
static_assert(wear_direction("hpt_flow") > 0.0);
static_assert(wear_direction("lpt_flow") > 0.0);

HealthConstraint down_up_free() {
  HealthVector direction(3);
  direction << -1.0, 1.0, 0.0;
  return HealthConstraint(direction);
}

TEST(HealthConstraint, BoundsOnlyTheSideThatWearDoesNotGoTo) {
  HealthConstraint constraint = down_up_free();
  EXPECT_TRUE((constraint.lower().array() == -std::numeric_limits<double>::infinity()).all());
  EXPECT_TRUE((constraint.upper().array() == std::numeric_limits<double>::infinity()).all());
  HealthVector h(3);
  h << -1.0, 2.0, 3.0;
  constraint.take(h);
  EXPECT_EQ(constraint.upper()(0), -1.0);
  EXPECT_EQ(constraint.lower()(1), 2.0);
  EXPECT_TRUE(std::isinf(constraint.lower()(0)) && std::isinf(constraint.upper()(1)));
  EXPECT_TRUE(std::isinf(constraint.lower()(2)) && std::isinf(constraint.upper()(2)));
}

TEST(HealthConstraint, NeverOpensButByMaintenance) {
  HealthConstraint constraint = down_up_free();
  HealthVector worn(3), better(3);
  worn << -1.0, 2.0, 0.0;
  better << 0.0, 0.0, 0.0;
  constraint.take(worn);
  constraint.take(better);
  EXPECT_EQ(constraint.upper()(0), -1.0);
  EXPECT_EQ(constraint.lower()(1), 2.0);
  constraint.lift();
  EXPECT_TRUE(std::isinf(constraint.upper()(0)) && std::isinf(constraint.lower()(1)));
}

TEST(HealthConstraint, GoesOnFromTheBoundsThatItHad) {
  HealthConstraint constraint = down_up_free(), successor = down_up_free();
  HealthVector h(3);
  h << -1.0, 2.0, 3.0;
  constraint.take(h);
  successor.take(constraint.bounds());
  EXPECT_EQ(successor.upper(), constraint.upper());
  EXPECT_EQ(successor.lower(), constraint.lower());
}

}  // namespace
}  // namespace ehm::estimation
