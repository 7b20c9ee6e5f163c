// SPDX-License-Identifier: Apache-2.0
// A sensor that was left out for a bias comes back when the bias has gone, though its prediction has moved a little
// meanwhile; it stays out as long as the bias stays, however wide the doubt.

#include "monitor/checks/bias_return.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using ehm::estimation::SensorVector;
using ehm::monitor::BiasReturn;

constexpr int never = -1;

/// Left out for a bias of 36, of which the finder's mean had seen 16; least 6. Sigma of the innovation `sigma`.
BiasReturn left_out() {
  BiasReturn back;
  back.leave_out(0, 16.0, 6.0);
  return back;
}

/// Samples until it is back with this constant innovation.
int back_after(BiasReturn& back, double innovation, double sigma, int samples) {
  for (int k = 0; k < samples; ++k) {
    back.look(SensorVector::Constant(1, innovation), SensorVector::Constant(1, sigma * sigma));
    if (back.sensor() < 0) return k;
  }
  return never;
}

TEST(BiasReturn, ABiasThatStaysKeepsItOutHoweverWideTheDoubt) {
  for (const double sigma : {1.0, 10.0, 100.0}) {
    BiasReturn back = left_out();
    EXPECT_EQ(back_after(back, 36.0, sigma, 20'000), never) << sigma;
    EXPECT_EQ(back.sensor(), 0);
  }
}

TEST(BiasReturn, ComesBackThoughItsPredictionHasMovedWithinTheDoubt) {
  BiasReturn back = left_out();
  ASSERT_EQ(back_after(back, 36.0, 11.0, 500), never);
  const int after = back_after(back, -10.0, 11.0, 2000);
  EXPECT_GT(after, BiasReturn::mean_samples);  // a mean time below, at least
  EXPECT_LT(after, 5 * BiasReturn::mean_samples);
}

// What the engine does later is no measure of the bias.
TEST(BiasReturn, ALaterChangeOfTheEngineDoesNotBringABiasBack) {
  BiasReturn back = left_out();
  ASSERT_EQ(back_after(back, 36.0, 100.0, 2000), never);
  ASSERT_EQ(back_after(back, 90.0, 100.0, 1000), never);  // a component steps
  EXPECT_EQ(back_after(back, 36.0, 100.0, 5000), never);  // and is learned: 36 is less than half of 90
}

TEST(BiasReturn, GoesOnFromItsMemory) {
  BiasReturn before = left_out(), after;
  ASSERT_EQ(back_after(before, 36.0, 11.0, 1000), never);
  after.remember(before.memory());
  EXPECT_EQ(after.sensor(), 0);
  EXPECT_EQ(back_after(after, 36.0, 100.0, 5000), never);
  EXPECT_NE(back_after(after, -2.0, 11.0, 2000), never);
}

TEST(BiasReturn, StaysOutBeyondTheDoubt) {
  BiasReturn back = left_out();
  ASSERT_EQ(back_after(back, 36.0, 2.0, 500), never);
  EXPECT_EQ(back_after(back, -10.0, 2.0, 20'000), never);  // 3 is 1.5 sigma and half of the least
  EXPECT_NE(back_after(back, -2.0, 2.0, 2000), never);
}

TEST(BiasReturn, ValuesThatAreNoNumbersSayNothing) {
  BiasReturn back = left_out();
  EXPECT_EQ(back_after(back, std::numeric_limits<double>::quiet_NaN(), 1.0, 2000), never);
}

TEST(BiasReturn, ForgetsByOrder) {
  BiasReturn back = left_out();
  back.forget();
  EXPECT_EQ(back.sensor(), -1);
}

}  // namespace
