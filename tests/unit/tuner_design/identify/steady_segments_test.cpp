// SPDX-License-Identifier: Apache-2.0
// What of a recording is compared with the model, and why the rest is not.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine_sim/linear_model/discretise.h"
#include "tests/unit/tuner_design/identify/walking_engine.h"
#include "tuner_design/identify/steady_segments.h"

namespace ehm::tuner_design {
namespace {

using Eigen::Index;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Index samples = 6000;

class SteadySegments : public ::testing::Test {
 protected:
  SteadySegments() {
    model_.operating_point = {10668.0, 0.8, 0.0};
    record_ = test::walking_engine(model_, test::noise_of(model_, 0.0), samples, 5);
  }
  SteadySelection select() const { return select_steady(record_, model_, {}); }
  static void expect_all_told(const SteadySelection& s) {
    EXPECT_EQ(s.used + s.missing + s.off_point + s.moving + s.too_short, s.recorded);
  }

  linear_model::LinearModel model_ = linear_model::discretise(test::jt9d_cruise());
  RecordedSamples record_;
};

TEST_F(SteadySegments, AQuietRecordingIsOne) {
  const SteadySelection s = select();
  ASSERT_EQ(s.segments.size(), 1U);
  EXPECT_EQ(s.used, samples);
  EXPECT_EQ(s.sensors.size(), 7U);
  EXPECT_EQ(s.jumps, 0);
}

TEST_F(SteadySegments, AGapAndAMissingValueDivideIt) {
  record_.gap_after = {1999};
  record_.sensors(2, 4000) = nan;
  const SteadySelection s = select();
  ASSERT_EQ(s.segments.size(), 3U);
  EXPECT_EQ(s.segments[1].begin, 2000);
  EXPECT_EQ(s.segments[1].length, 2000);
  EXPECT_EQ(s.missing, 1);
  EXPECT_EQ(s.gaps, 1);
  expect_all_told(s);
}

TEST_F(SteadySegments, ASensorThatIsMostlyMissingIsLeftOutAlone) {
  record_.sensors.row(3).head(1000).setConstant(nan);
  const SteadySelection s = select();
  EXPECT_EQ(s.sensors, (std::vector<int>{0, 1, 2, 4, 5, 6}));
  EXPECT_EQ(s.used, samples);
}

TEST_F(SteadySegments, OffThePointAndOnTheWayThereIsNotSteady) {
  record_.flight.row(0).tail(2000).array() += 700.0;  // tolerance 600 m
  EXPECT_EQ(select().off_point, 2000);
  record_.flight.row(0).tail(2000).array() -= 300.0;
  const SteadySelection step = select();
  EXPECT_EQ(step.off_point, 0);
  // One or two pairs of windows about the step, and the settling after them.
  EXPECT_NEAR(static_cast<double>(step.moving), static_cast<double>(2 * step.window + step.settling),
              1.1 * static_cast<double>(step.window));
  ASSERT_EQ(step.segments.size(), 2U);
  EXPECT_LE(step.segments[0].begin + step.segments[0].length, 4000);
  EXPECT_GE(step.segments[1].begin, 4000);
  expect_all_told(step);
}

TEST_F(SteadySegments, ASteadyClimbIsMotionThroughout) {
  for (Index k = 0; k < samples; ++k)  // 60 m a window is the tenth of a tolerance
    record_.flight(0, k) += 0.5 * static_cast<double>(k - samples / 2);
  const SteadySelection s = select();
  EXPECT_TRUE(s.segments.empty());
  expect_all_told(s);
}

TEST_F(SteadySegments, ASlowClimbIsCutWithoutALoss) {
  for (Index k = 0; k < samples; ++k) record_.flight(0, k) += 0.04 * static_cast<double>(k - samples / 2);  // 240 m
  const SteadySelection s = select();
  EXPECT_GE(s.drifts, 3);
  EXPECT_EQ(s.segments.size(), static_cast<std::size_t>(s.drifts) + 1);
  EXPECT_GE(s.used, samples - s.least_length);
  expect_all_told(s);
}

TEST_F(SteadySegments, AStepOfAnActuatorIsLeftOutWithItsSettling) {
  record_.controls.row(0).segment(3000, 1000).array() *= 1.05;
  const SteadySelection s = select();
  for (const Span& segment : s.segments) {
    const bool about_a_step = segment.begin < 3000 && segment.begin + segment.length > 3000;
    EXPECT_FALSE(about_a_step);
  }
  EXPECT_GT(s.moving, 0);
  EXPECT_GT(s.used, samples / 3);
  expect_all_told(s);
}

TEST_F(SteadySegments, ABiasCutsWithoutALossAndASpikeCostsItsSample) {
  record_.sensors.row(5).tail(3000).array() *= 1.2;
  const SteadySelection bias = select();
  EXPECT_EQ(bias.jumps, 1);
  EXPECT_EQ(bias.used, samples);
  EXPECT_EQ(bias.segments.size(), 2U);
  record_.sensors(0, 1500) *= 1.2;
  const SteadySelection spike = select();
  EXPECT_EQ(spike.jumps, 3);
  EXPECT_EQ(spike.used, samples - 1);
  EXPECT_EQ(spike.too_short, 1);
}

TEST_F(SteadySegments, ShortPiecesAreNotUsed) {
  for (Index k = 400; k < samples; k += 400) record_.gap_after.push_back(k);
  const SteadySelection s = select();
  EXPECT_TRUE(s.segments.empty());
  EXPECT_EQ(s.too_short, samples);
}

}  // namespace
}  // namespace ehm::tuner_design
