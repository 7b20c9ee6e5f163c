// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/return_gate.h"

#include <gtest/gtest.h>

namespace {

using ehm::monitor::ReturnGate;

// A sensor with noise variance 1 whose prediction without it is 3 off and uncertain by variance 100.
ReturnGate gate() {
  ReturnGate g;
  g.start(3.0, 1.0, 100.0, 0.0);
  return g;
}

TEST(ReturnGate, RemembersWhereThePredictionStood) {
  EXPECT_DOUBLE_EQ(gate().ratio(3.0, 5.0), 0.0);
  EXPECT_GT(gate().ratio(3.0 + 10.0, 5.0), 1.0);  // a ten sigma bias stays out, though 13 is 1.3 of the wide sigma
}

TEST(ReturnGate, ForgetsAfterAHour) {
  ReturnGate g = gate();
  for (int i = 0; i < 3600; ++i) g.step(1.0);
  EXPECT_DOUBLE_EQ(g.ratio(10.0, 5.0), 100.0 / (25.0 * 100.0));
}

TEST(ReturnGate, ForgetsAtOnceWhenTheEngineChanged) {
  ReturnGate g = gate();
  g.forget();
  EXPECT_LT(g.ratio(13.0, 5.0), 1.0);
}

TEST(ReturnGate, ABiasThatStaysWaitsOutsideThoughEachValueWouldPass) {
  ReturnGate g;
  g.start(3.0, 1.0, 100.0, 2.0);
  for (int i = 0; i < 500; ++i) {
    g.observe(3.0 + 2.0);
    EXPECT_GT(g.ratio(5.0, 5.0), 1.0);
  }
  for (int i = 0; i < 50; ++i) g.observe(3.0);  // one time constant of the mean: 2/e is left, less than half
  EXPECT_LT(g.ratio(3.0, 5.0), 1.0);
}

TEST(ReturnGate, ANoisySensorWaitsOutsideUntilItIsQuiet) {
  ReturnGate g = gate();
  for (int i = 0; i < 500; ++i) g.observe(i % 2 ? 3.0 + 2.0 : 3.0 - 2.0);  // twice the sigma
  EXPECT_GT(g.ratio(3.0, 5.0), 1.0);
  for (int i = 0; i < 500; ++i) g.observe(i % 2 ? 3.0 + 1.0 : 3.0 - 1.0);
  EXPECT_LT(g.ratio(3.0, 5.0), 1.0);
}

}  // namespace
