// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/stuck_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using ehm::monitor::SensorKind;
using ehm::monitor::StuckWatch;

constexpr int hour = 240'000;  // samples of 15 ms

/// A healthy sensor about 700.3: noise of sigma, rounded to the resolution, each value held for some samples.
struct Healthy {
  double sigma = 1.0, resolution = 0.0;
  int held = 1;
  std::mt19937_64 random{3};
  std::normal_distribution<double> normal{};
  double value = 0.0;
  int count = 0;

  double next() {
    if (count++ % held == 0) {
      value = 700.3 + sigma * normal(random);
      if (resolution > 0.0) value = resolution * std::round(value / resolution);
    }
    return value;
  }
};

/// Samples in which it was called frozen.
int called_frozen(StuckWatch& watch, Healthy healthy, int samples) {
  int frozen = 0;
  for (int i = 0; i < samples; ++i) {
    watch.take(healthy.next(), 1);
    frozen += watch.frozen();
  }
  return frozen;
}

/// Samples until a value that stays is called frozen, -1 for never.
int found_after(StuckWatch& watch, double value, int limit = hour) {
  for (int i = 1; i <= limit; ++i) {
    watch.take(value, 1);
    if (watch.frozen()) return i;
  }
  return -1;
}

// p = erf(q / (sqrt(8) s)) is the normal probability of +-q/2: 0.383, 0.683, 0.954 within 0.5, 1, 2 sigma (any table);
// 1 + ln(1e-12) / ln(p) = 29.8, 73.4, 594.4.
TEST(StuckWatch, TheLimitFollowsFromResolutionAndNoise) {
  const auto limit = [](double q, double s) { return StuckWatch::stated_limit({.noise_sigma = s, .resolution = q}); };
  EXPECT_EQ(limit(0.01, 1.0), 20);  // checks.stuck_samples at least
  EXPECT_EQ(limit(1.0, 1.0), 30);
  EXPECT_EQ(limit(1.0, 0.5), 74);
  EXPECT_EQ(limit(1.0, 0.25), 595);
  EXPECT_EQ(limit(1.0, 0.1), StuckWatch::never);
}

TEST(StuckWatch, AStatedKindIsJudgedFromTheFirstValueOn) {
  StuckWatch watch({.noise_sigma = 0.5, .resolution = 1.0, .update_samples = 33});
  EXPECT_EQ(watch.limit(), 74 * 33);
  EXPECT_EQ(found_after(watch, 700.0), 74 * 33);
}

TEST(StuckWatch, HealthySensorsAreNotCalledFrozen) {
  for (const Healthy& healthy :
       {Healthy{}, Healthy{.sigma = 5.0, .resolution = 1.0}, Healthy{.resolution = 1.0},
        Healthy{.sigma = 0.5, .resolution = 1.0}, Healthy{.sigma = 0.2, .resolution = 1.0},
        Healthy{.sigma = 0.1, .resolution = 1.0}, Healthy{.sigma = 0.0, .resolution = 1.0}, Healthy{.held = 33},
        Healthy{.sigma = 5.0, .resolution = 1.0, .held = 33}, Healthy{.sigma = 0.5, .resolution = 1.0, .held = 33}}) {
    SCOPED_TRACE(testing::Message() << "sigma " << healthy.sigma << ", resolution " << healthy.resolution << ", held "
                                    << healthy.held);
    StuckWatch untold(SensorKind{.noise_sigma = 5.0});
    EXPECT_EQ(called_frozen(untold, healthy, hour), 0);
    StuckWatch told({.noise_sigma = healthy.sigma, .resolution = healthy.resolution, .update_samples = healthy.held});
    EXPECT_EQ(called_frozen(told, healthy, hour), 0);
  }
}

TEST(StuckWatch, FindsAFrozenOneInReasonableTime) {
  const auto frozen_after = [](const Healthy& healthy) {
    StuckWatch watch(SensorKind{.noise_sigma = 5.0});
    called_frozen(watch, healthy, 5000);
    return found_after(watch, 712.0);
  };
  EXPECT_EQ(frozen_after({}), 20);
  EXPECT_LE(frozen_after({.sigma = 5.0, .resolution = 1.0}), 40);
  EXPECT_LE(frozen_after({.resolution = 1.0}), 100);
  EXPECT_EQ(frozen_after({.held = 33}), 6 * 33);  // 3 s at 15 ms
}

TEST(StuckWatch, ARampOfACoarseSensorTeachesNothingWrong) {
  StuckWatch watch(SensorKind{.noise_sigma = 5.0});
  for (int i = 0; i < 600; ++i) watch.take(std::round(700.0 + 0.3 * i), 1);  // 20 K/s
  for (int i = 0; i < 600; ++i) watch.take(std::round(880.0 - 1.7 * i), 1);
  EXPECT_EQ(watch.hold(), 1);
  EXPECT_EQ(found_after(watch, 640.0), -1);
}

TEST(StuckWatch, LearnsTheHoldOfASlowSensorAndTellsItsNews) {
  StuckWatch watch(SensorKind{.noise_sigma = 1.0});
  Healthy healthy{.held = 33};
  called_frozen(watch, healthy, 20 * 33);
  EXPECT_EQ(watch.hold(), 33);
  healthy.count = 0;
  int news = 0;
  for (int i = 0; i < 10 * 33; ++i) {
    watch.take(healthy.next(), 1);
    news += watch.fresh();
  }
  EXPECT_EQ(news, 10);
}

TEST(StuckWatch, LostSamplesCountInARun) {
  StuckWatch watch({.operators_limit = 10});
  watch.take(1.0, 1);
  watch.take(1.0, 8);
  EXPECT_FALSE(watch.frozen());
  watch.take(1.0, 1);
  EXPECT_TRUE(watch.frozen());
}

}  // namespace
