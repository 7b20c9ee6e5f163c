// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/quiet_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace {

using ehm::monitor::QuietWatch;

constexpr int hour = 240'000;  // samples of 15 ms

struct Noise {
  double sigma = 1.0, resolution = 0.0;
  std::mt19937_64 random{11};
  std::normal_distribution<double> normal{};
  double next() {
    const double value = 700.3 + sigma * normal(random);
    return resolution > 0.0 ? resolution * std::round(value / resolution) : value;
  }
};

void show(QuietWatch& watch, Noise noise, int samples = 4000) {
  for (int i = 0; i < samples; ++i) watch.take(noise.next());
}

/// Samples until it is called frozen, -1 for never.
int found_after(QuietWatch& watch, const std::function<double(int)>& value, int limit = 10'000) {
  for (int i = 0; i < limit; ++i) {
    watch.take(value(i));
    if (watch.frozen()) return i + 1;
  }
  return -1;
}

TEST(QuietWatch, FindsAFrozenWordWhoseLastBitsToggle) {
  const auto last_bit = [](int i) { return i % 2 ? 700.3 : std::nextafter(700.3, 800.0); };
  const auto converter = [](int i) { return 700.3 + 0.3 * (i / 3 % 2); };  // a step of a third of the noise
  const auto dither = [n = Noise{.sigma = 0.02}](int) mutable { return n.next(); };
  for (const std::function<double(int)>& frozen : {std::function<double(int)>(last_bit), {converter}, {dither}}) {
    QuietWatch watch;
    show(watch, {});
    const int after = found_after(watch, frozen);
    EXPECT_GE(after, 64);
    EXPECT_LE(after, 2 * 64);
    EXPECT_LT(watch.range(), watch.least());
    show(watch, {}, 128);  // it moves again
    EXPECT_FALSE(watch.frozen());
  }
}

TEST(QuietWatch, AHealthySensorIsNotFrozen) {
  for (const Noise& healthy : {Noise{}, Noise{.resolution = 0.3}, Noise{.resolution = 1.0}, Noise{.resolution = 2.0},
                               Noise{.resolution = 4.0}, Noise{.resolution = 8.0}}) {
    QuietWatch watch;
    Noise noise = healthy;
    EXPECT_EQ(found_after(
                  watch, [&](int) { return noise.next(); }, hour),
              -1)
        << healthy.resolution;
  }
}

TEST(QuietWatch, ASensorWithoutNoiseHasNoneToLose) {
  QuietWatch settles, creeps, rounds;
  EXPECT_EQ(found_after(
                settles, [](int i) { return 700.0 + 50.0 * std::exp(-i / 20.0); }, hour),
            -1);
  EXPECT_EQ(found_after(
                creeps, [](int i) { return 700.0 + std::sin(1e-3 * i); }, hour),
            -1);
  // a simulation's round-off, then a standstill, which stuck_watch.h judges
  EXPECT_EQ(found_after(
                rounds, [](int i) { return i < 3000 ? 700.0 + 1e-13 * (i % 3) + 1e-3 * i : 703.0; }, hour),
            -1);
}

TEST(QuietWatch, MotionWidensButNeverHidesTheMeasure) {
  // The engine accelerates while the reference is learnt: the smallest range stays that of the noise.
  QuietWatch watch;
  Noise noise;
  for (int i = 0; i < 4000; ++i) watch.take(noise.next() + (i < 2000 ? 0.1 * i : 200.0));
  EXPECT_LT(watch.least(), 2.0);  // a quarter of less than eight sigma
  EXPECT_GT(found_after(watch, [](int i) { return 900.0 + 1e-9 * (i % 2); }), 0);
}

TEST(QuietWatch, JudgesNothingBeforeItHasSeenEnough) {
  QuietWatch watch;
  show(watch, {}, 7 * 64);
  EXPECT_EQ(watch.least(), 0.0);
  EXPECT_EQ(found_after(watch, [](int i) { return 700.0 + 1e-9 * (i % 2); }), -1);
}

}  // namespace
