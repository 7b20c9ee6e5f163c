// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/sensors/sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using ehm::NoiseSource;
using namespace ehm::engine_sim;

constexpr double dt_s = 0.015;

TEST(NoiseSource, IsStandardNormal) {
  NoiseSource noise(1);
  constexpr int n = 200'000;
  double sum = 0, square = 0, fourth = 0;
  for (int i = 0; i < n; ++i) {
    const double x = noise.normal();
    sum += x, square += x * x, fourth += x * x * x * x;
  }
  // Standard errors: mean 1/sqrt(n), variance sqrt(2/n), fourth moment sqrt(96/n).
  EXPECT_NEAR(sum / n, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(square / n, 1.0, 4.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth / n, 3.0, 4.0 * std::sqrt(96.0 / n));
}

TEST(NoiseSource, IsTheSameEverywhere) {
  // mt19937_64 with seed 1 starts 2469588189546311528, 2516265689700432462 (C++ standard's generator); Box-Muller by
  // hand.
  NoiseSource noise(1);
  const double u1 = (static_cast<double>(2469588189546311528ull >> 11) + 1.0) * 0x1p-53;
  const double u2 = (static_cast<double>(2516265689700432462ull >> 11) + 1.0) * 0x1p-53;
  EXPECT_DOUBLE_EQ(noise.normal(), std::sqrt(-2.0 * std::log(u1)) * std::cos(2.0 * M_PI * u2));
}

TEST(Sensor, PerfectSensorReadsTheTruth) {
  NoiseSource noise(1);
  Sensor sensor({});
  EXPECT_DOUBLE_EQ(sensor.read(700.0, 0.0, dt_s, noise).value, 700.0);
}

TEST(Sensor, LagFollowsTheExactFirstOrderResponse) {
  NoiseSource noise(1);
  Sensor sensor({0.0, 0.5, 0.0});
  sensor.read(0.0, 0.0, dt_s, noise);
  Reading r;
  for (int k = 1; k <= 100; ++k) r = sensor.read(1.0, k * dt_s, dt_s, noise);
  EXPECT_NEAR(r.value, 1.0 - std::exp(-100 * dt_s / 0.5), 1e-12);
}

TEST(Sensor, QuantisesToTheStep) {
  NoiseSource noise(1);
  Sensor sensor({0.0, 0.0, 0.25});
  EXPECT_DOUBLE_EQ(sensor.read(10.1, 0.0, dt_s, noise).value, 10.0);
  EXPECT_DOUBLE_EQ(sensor.read(10.2, 0.0, dt_s, noise).value, 10.25);
}

TEST(Sensor, HoldsAValueThroughItsFaults) {
  NoiseSource noise(1);
  Sensor sensor({.held_samples = 3});
  const auto read = [&](double truth) { return sensor.read(truth, 0.0, dt_s, noise); };
  EXPECT_DOUBLE_EQ(read(1.0).value, 1.0);
  EXPECT_DOUBLE_EQ(read(2.0).value, 1.0);
  sensor.inject({FaultKind::bias, 10.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(read(3.0).value, 1.0);  // felt when it speaks again
  EXPECT_DOUBLE_EQ(read(4.0).value, 14.0);
  sensor.inject({FaultKind::dropout, 0.0, 0.0, 0.0});
  EXPECT_FALSE(read(5.0).valid);
  sensor.inject({});
  EXPECT_DOUBLE_EQ(read(6.0).value, 14.0);
  EXPECT_DOUBLE_EQ(read(7.0).value, 7.0);
}

TEST(Sensor, FaultsDoWhatTheySayForAsLongAsTheySay) {
  NoiseSource noise(1);
  Sensor sensor({});
  const auto read = [&](double truth, double time_s) { return sensor.read(truth, time_s, dt_s, noise); };
  sensor.inject({FaultKind::bias, 5.0, 1.0, 2.0});
  EXPECT_DOUBLE_EQ(read(100.0, 0.9).value, 100.0);
  EXPECT_DOUBLE_EQ(read(100.0, 1.0).value, 105.0);
  EXPECT_DOUBLE_EQ(read(100.0, 3.0).value, 100.0);
  sensor.inject({FaultKind::drift, 0.5, 10.0, 0.0});
  EXPECT_DOUBLE_EQ(read(100.0, 14.0).value, 102.0);
  sensor.inject({FaultKind::stuck, 0.0, 20.0, 0.0});
  EXPECT_DOUBLE_EQ(read(90.0, 21.0).value, 102.0);
  sensor.inject({FaultKind::dropout, 0.0, 30.0, 0.0});
  EXPECT_FALSE(read(90.0, 31.0).valid);
  EXPECT_TRUE(std::isnan(read(90.0, 31.0).value));
}

TEST(Sensor, AFaultLeavesTheNoiseOfTheOthersAlone) {
  NoiseSource healthy(4), faulty(4);
  Sensor a({1.0, 0, 0}), b({1.0, 0, 0}), a2({1.0, 0, 0}), b2({1.0, 0, 0});
  a2.inject({FaultKind::dropout, 0, 0, 0});
  for (int k = 0; k < 10; ++k) {
    a.read(0, k, dt_s, healthy);
    a2.read(0, k, dt_s, faulty);
    EXPECT_EQ(b.read(0, k, dt_s, healthy).value, b2.read(0, k, dt_s, faulty).value);
  }
}

}  // namespace
