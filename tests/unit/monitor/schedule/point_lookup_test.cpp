// SPDX-License-Identifier: Apache-2.0
// A table whose numbers are straight in its variables is exact between its nodes, and scales by similarity.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/monitor/schedule/small_schedule.h"

namespace {

using namespace ehm;
using namespace ehm::schedule;

TEST(PointLookup, IsExactWhereTheTableIsStraight) {
  const PointLookup lookup(test::small_schedule());
  for (const auto& [n1, mach] : {std::pair{1000.0, 0.0}, {1200.0, 0.3}, {2999.0, 0.79}, {1500.0, 0.8}}) {
    PointModel model;
    ASSERT_TRUE(lookup.at({n1, mach, 1.0, 1.0, 0.0}, model));
    const Node node = test::node_at(n1, mach);
    EXPECT_NEAR(model.y0(1), node.y0(1), 1e-9);
    EXPECT_NEAR(model.u0(0), node.u0(0), 1e-12);
    EXPECT_NEAR(model.M(1, 1), node.M(1, 1), 1e-12);
    EXPECT_NEAR(model.z0(0), node.z0(0), 1e-9);
  }
}

// By hand: theta 0.81, delta 0.25. A speed by 0.9, a temperature by 0.81, a fuel flow by 0.25 0.9, thrust by 0.25; time
// by delta/sqrt(theta) = 0.277778: A as it is times that, dT/dN by 0.81/0.9.
TEST(PointLookup, ScalesBySimilarity) {
  const PointLookup lookup(test::small_schedule());
  PointModel model;
  ASSERT_TRUE(lookup.at({2000.0, 0.4, 0.81, 0.25, 0.0}, model));
  const Node node = test::node_at(2000.0, 0.4);
  EXPECT_NEAR(model.x0(0), 0.9 * 2000.0, 1e-9);
  EXPECT_NEAR(model.y0(1), 0.81 * node.y0(1), 1e-9);
  EXPECT_NEAR(model.u0(0), 0.225 * node.u0(0), 1e-12);
  EXPECT_NEAR(model.z0(0), 0.25 * node.z0(0), 1e-9);
  EXPECT_NEAR(model.A(0, 0), -0.25 / 0.9, 1e-12);
  EXPECT_NEAR(model.C(1, 0), 0.2 * 0.81 / 0.9, 1e-12);
  EXPECT_NEAR(model.B(0, 0), 1000.0 * (0.25 / 0.9) * 0.9 / 0.225, 1e-9);
  EXPECT_NEAR(model.L(0, 1), -3.0 * (0.25 / 0.9) * 0.9, 1e-12);
  Schedule as_they_are = test::small_schedule();
  as_they_are.reduced = false;
  ASSERT_TRUE(PointLookup(as_they_are).at({2000.0, 0.4, 0.81, 0.25, 0.0}, model));
  EXPECT_NEAR(model.y0(1), node.y0(1), 1e-9);
  EXPECT_NEAR(model.A(0, 0), -1.0, 1e-12);
}

TEST(PointLookup, OutsideTheEdgeAnswersAndTellsHowFar) {
  const PointLookup lookup(test::small_schedule());
  PointModel model;
  ASSERT_TRUE(lookup.at({4000.0, 0.9, 1.0, 1.0, 0.0}, model));
  EXPECT_NEAR(model.x0(0), 3000.0, 1e-9);
  EXPECT_NEAR(lookup.outside({4500.0, 0.4, 1.0, 1.0, 0.0}), 1.0, 1e-12);  // a cell of 1500 rpm
  EXPECT_NEAR(lookup.outside({2000.0, 1.0, 1.0, 1.0, 0.0}), 0.25, 1e-12);
  EXPECT_EQ(lookup.outside({2000.0, 0.4, 1.0, 1.0, 0.0}), 0.0);
}

TEST(PointLookup, WhereTheEngineDoesNotRunThereIsNoAnswer) {
  Schedule s = test::small_schedule();
  s.nodes[0].valid = false;  // 1000 rpm, Mach 0
  const PointLookup lookup(s);
  PointModel model;
  EXPECT_FALSE(lookup.at({1010.0, 0.01, 1.0, 1.0, 0.0}, model));
  ASSERT_TRUE(lookup.at({1400.0, 0.4, 1.0, 1.0, 0.0}, model));
  EXPECT_NEAR(model.x0(0), 1400.0, 60.0) << "the other corners, weighted anew";
}

TEST(PointLookup, FindsTheSpeedOfAFuelFlow) {
  const PointLookup lookup(test::small_schedule());
  const double fuel = 0.5 + 1e-3 * 1700.0 + 0.1 * 0.4;
  EXPECT_NEAR(lookup.n1_of_actuator(0, fuel, {0.0, 0.4, 1.0, 1.0, 0.0}), 1700.0, 1e-6);
}

TEST(PointLookup, WhatFillsNoGridIsRefused) {
  Schedule s = test::small_schedule();
  s.nodes.pop_back();
  EXPECT_THROW(PointLookup{s}, std::invalid_argument);
  s = test::small_schedule();
  s.axes[0].points = {1000.0, 1000.0, 3000.0};
  EXPECT_THROW(PointLookup{s}, std::invalid_argument);
  s = test::small_schedule();
  s.nodes[3].y0.conservativeResize(1);
  EXPECT_THROW(PointLookup{s}, std::invalid_argument);
}

}  // namespace
