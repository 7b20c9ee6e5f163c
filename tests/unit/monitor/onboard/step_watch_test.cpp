// SPDX-License-Identifier: Apache-2.0
// A step of health, or a bias of a sensor, in the mean innovation of a filter that has learned: found, named, and with
// its size; noise, and what no single cause explains, are not.

#include "monitor/onboard/step_watch.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "deploy/runtime/numbers/noise_source.h"
#include "engine_sim/mismatch/mismatch.h"
#include "tests/unit/monitor/onboard/on_board_point.h"

namespace ehm::onboard {
namespace {

using estimation::SensorMask;
using estimation::SensorVector;

/// At cruise, after a flight that has taught everything to a hundredth of a percent.
class LearnedFilter : public ::testing::Test {
 protected:
  LearnedFilter() {
    covariance_.start(1e-4 * UnknownMatrix::Identity(layout_.health_count + layout_.cause_count,
                                                     layout_.health_count + layout_.cause_count));
    doubt_ = {SensorVector::Constant(m_, noise_ * noise_), SensorVector::Constant(m_, 0.05 * 0.05)};
    for (Eigen::Index i = 0; i < m_; ++i) all_.set(as_size(i));
  }

  /// Takes so many seconds of innovations with this mean; the seconds until something was found, or -1.
  double watch(const SensorVector& mean, double seconds, SensorMask in_use) {
    return watch(mean, seconds, in_use, [](int, SensorVector&) {});
  }
  /// The same with every sample through `spoil(k, innovation)`.
  template <class Spoil>
  double watch(const SensorVector& mean, double seconds, SensorMask in_use, const Spoil& spoil) {
    const double dt_s = point_.model->options().sample_time_s;
    estimation::Innovation percent{mean, SensorVector::Constant(m_, noise_ * noise_)};
    for (int k = 1; k * dt_s <= seconds; ++k) {
      percent.value = mean;
      for (Eigen::Index i = 0; i < m_; ++i) percent.value(i) += noise_ * random_.normal();
      spoil(k, percent.value);
      if (watch_.take(percent, in_use, gated_ ? SensorMask{} : in_use, point_.tangent, covariance_, doubt_))
        return k * dt_s;
    }
    return -1.0;
  }

  static constexpr double noise_ = 0.3;
  bool gated_ = false;  ///< the gate holds every reading back
  test::OnBoardPoint point_ = test::on_board_cruise();
  UnknownLayout layout_{*point_.model};
  const Eigen::Index m_ = layout_.sensor_count;
  UnknownCovariance covariance_{layout_};
  StepWatch watch_{layout_, point_.model->options()};
  ReadingDoubt doubt_;
  SensorMask all_;
  NoiseSource random_{5};
};

TEST_F(LearnedFilter, NamesEachParameterThatStepsWithItsSizeWithinTenSeconds) {
  for (Eigen::Index j = 0; j < layout_.health_count; ++j) {
    for (const double percent : {-2.0, 2.0}) {
      const SensorVector slope = point_.tangent.settled_health().col(j);
      watch_.reset();
      const double after_s = watch(percent * slope, 20.0, all_);
      ASSERT_GT(after_s, 0.0) << j;
      EXPECT_LT(after_s, 10.0) << j;
      EXPECT_EQ(watch_.finding().parameter, j);
      // the mean has seen four seconds or more of its two: at least 1 - exp(-2), but for noise
      EXPECT_NEAR(watch_.finding().size_percent / percent, 0.95, 0.15) << j;
      EXPECT_LT(watch_.finding().threshold_percent, std::abs(percent)) << j;
      EXPECT_NEAR(watch_.finding().health.sum() + watch_.finding().sensor.sum(), 1.0, 1e-12);
    }
  }
}

TEST_F(LearnedFilter, ABiasOfOneSensorIsNotTakenForHealth) {
  for (Eigen::Index i = 0; i < m_; ++i) {
    watch_.reset();
    ASSERT_GT(watch(2.0 * SensorVector::Unit(m_, i), 20.0, all_), 0.0) << i;
    EXPECT_EQ(watch_.finding().parameter, -1) << i;
    EXPECT_GT(watch_.finding().sensor(i), 0.99) << i;
  }
}

TEST_F(LearnedFilter, FindsNothingInAnHourOfNoise) {
  EXPECT_LT(watch(SensorVector::Zero(m_), 3600.0, all_), 0.0);
}

TEST_F(LearnedFilter, WhatNoSingleCauseExplainsIsNotFound) {
  int mixed = 0;
  for (Eigen::Index i = 0; i < m_; ++i) {
    for (Eigen::Index k = 0; k < i; ++k) {
      watch_.reset();
      if (watch(2.0 * (SensorVector::Unit(m_, i) - SensorVector::Unit(m_, k)), 20.0, all_) > 0.0) {
        EXPECT_GE(watch_.finding().parameter, 0) << "two sensors at once are none";
        continue;
      }
      EXPECT_GT(watch_.statistic(), point_.model->options().step_threshold);
      ++mixed;
    }
  }
  EXPECT_GT(mixed, 10);  // of 21 pairs; the others look like a parameter
}

TEST_F(LearnedFilter, SpikesOfASensorAreNoStep) {
  const auto spikes = [](int k, SensorVector& innovation) {
    if (k % 60 == 0) innovation(2) += 1000.0;
  };
  gated_ = true;  // as it does with a spike
  EXPECT_LT(watch(SensorVector::Zero(m_), 120.0, all_, spikes), 0.0);
}

TEST_F(LearnedFilter, ABiasIsFoundThoughReadingsAreHeldBackAndMissing) {
  const auto gaps = [](int k, SensorVector& innovation) {
    if (k % 3 == 0) innovation(2) = std::numeric_limits<double>::quiet_NaN();
  };
  gated_ = true;
  const double after_s = watch(5.0 * noise_ * SensorVector::Unit(m_, 2), 20.0, all_, gaps);
  EXPECT_GT(after_s, 0.0);
  EXPECT_LT(after_s, 5.0);
  EXPECT_GT(watch_.finding().sensor(2), 0.99);
}

TEST_F(LearnedFilter, ASensorThatIsNotInUseTellsNothing) {
  SensorMask others = all_;
  others.reset(6);
  EXPECT_LT(watch(5.0 * SensorVector::Unit(m_, 6), 60.0, others), 0.0);
}

TEST_F(LearnedFilter, AFilterThatKnowsLittleIsNotAlarmed) {
  const Eigen::Index n = layout_.health_count + layout_.cause_count;
  covariance_.start(4.0 * UnknownMatrix::Identity(n, n));
  covariance_.open(0, UnknownVector::Constant(speed_count, 4.0));  // which health moves
  EXPECT_LT(watch(2.0 * point_.tangent.settled_health().col(4), 60.0, all_), 0.0);
}

}  // namespace
}  // namespace ehm::onboard
