// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/innovation_gate.h"

#include <gtest/gtest.h>

#include <limits>

#include "deploy/runtime/numbers/index.h"

namespace {

using namespace ehm;

estimation::SensorVector vector(std::initializer_list<double> values) {
  estimation::SensorVector v(as_index(values.size()));
  Eigen::Index i = 0;
  for (double value : values) v(i++) = value;
  return v;
}

TEST(InnovationGate, RatioIsTheSquareInGateSigmas) {
  const auto d = monitor::innovation_gate(vector({10.0, 1.0}), vector({4.0, 1.0}), 0b11, 5.0);
  EXPECT_DOUBLE_EQ(d.ratio(0), 1.0);  // 5 sigma exactly
  EXPECT_DOUBLE_EQ(d.ratio(1), 0.04);
  EXPECT_TRUE(d.rejected.none());  // above 1 closes, 1 does not
}

TEST(InnovationGate, RejectsASingleSensorOutside) {
  const auto d = monitor::innovation_gate(vector({0.0, 5.1, 0.0}), vector({1.0, 1.0, 1.0}), 0b111, 5.0);
  EXPECT_EQ(d.rejected.to_ulong(), 0b010u);
}

TEST(InnovationGate, SeveralOutsideAreTheEngineAndAreFused) {
  const auto d = monitor::innovation_gate(vector({9.0, 9.0, 0.0}), vector({1.0, 1.0, 1.0}), 0b111, 5.0);
  EXPECT_TRUE(d.rejected.none());
}

TEST(InnovationGate, OneOutsideAmongRestlessOthersIsTheEngine) {
  // The three others sum to 27 where three degrees of freedom with four standard deviations allow 12.8.
  const auto d = monitor::innovation_gate(vector({9.0, 3.0, 3.0, -3.0}), vector({1.0, 1.0, 1.0, 1.0}), 0b1111, 5.0);
  EXPECT_TRUE(d.rejected.none());
}

TEST(InnovationGate, SensorsThatAreNotOfferedDoNotCount) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto d = monitor::innovation_gate(vector({9.0, 9.0, nan}), vector({1.0, 1.0, 1.0}), 0b001, 5.0);
  EXPECT_EQ(d.rejected.to_ulong(), 0b001u);
}

}  // namespace
