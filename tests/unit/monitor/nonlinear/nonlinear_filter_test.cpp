// SPDX-License-Identifier: Apache-2.0
// What every nonlinear filter promises (monitor/nonlinear/nonlinear_filter.h): one suite, a row for each.

#include "monitor/nonlinear/nonlinear_filter.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "monitor/nonlinear/extended_filter.h"
#include "monitor/nonlinear/extended_particle_filter.h"
#include "monitor/nonlinear/unscented_filter.h"
#include "tests/unit/monitor/nonlinear/linear_space.h"

namespace {

using namespace ehm::nonlinear;
using ehm::nonlinear::test::Flight;
using ehm::nonlinear::test::some_noise;
using ehm::nonlinear::test::some_prior;
using ehm::nonlinear::test::some_sigma;
using ehm::nonlinear::test::some_space;

constexpr SensorMask all(7);

struct Row {
  const char* name;
  std::function<std::unique_ptr<NonlinearFilter>()> make;
  bool exact;  ///< on a linear model it is the Kalman filter
  friend void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }
};

UnscentedOptions unscented(SigmaSet set, UnscentedForm form) {
  UnscentedOptions options;
  options.points.set = set;
  options.form = form;
  return options;
}

const std::vector<Row>& rows() {
  static const std::vector<Row> rows{
      {"extended", [] { return std::make_unique<ExtendedFilter>(some_noise(), ExtendedOptions{}); }, true},
      {"iterated", [] { return std::make_unique<ExtendedFilter>(some_noise(), ExtendedOptions{.iterations = 5}); },
       true},
      {"unscented",
       [] {
         return std::make_unique<UnscentedFilter>(some_noise(),
                                                  unscented(SigmaSet::symmetric, UnscentedForm::additive));
       },
       true},
      {"unscented_spherical",
       [] {
         return std::make_unique<UnscentedFilter>(some_noise(),
                                                  unscented(SigmaSet::spherical_simplex, UnscentedForm::additive));
       },
       true},
      {"unscented_skew",
       [] {
         return std::make_unique<UnscentedFilter>(some_noise(),
                                                  unscented(SigmaSet::minimal_skew, UnscentedForm::additive));
       },
       true},
      {"unscented_augmented",
       [] {
         return std::make_unique<UnscentedFilter>(some_noise(),
                                                  unscented(SigmaSet::symmetric, UnscentedForm::augmented));
       },
       true},
      {"particle", [] { return std::make_unique<ParticleFilter>(some_noise(), ParticleOptions{.particles = 2000}); },
       false},
      {"extended_particle",
       [] {
         return std::make_unique<ExtendedParticleFilter>(
             some_noise(),
             ExtendedParticleOptions{.cloud = {.particles = 2000}, .weights = ParticleWeights::ratio, .box = {}});
       },
       false},
      {"extended_particle_own",
       [] {
         return std::make_unique<ExtendedParticleFilter>(some_noise(),
                                                         ExtendedParticleOptions{.cloud = {.particles = 500},
                                                                                 .weights = ParticleWeights::ratio,
                                                                                 .jacobian = ParticleJacobian::own,
                                                                                 .box = {}});
       },
       false}};
  return rows;
}

/// One sample as the estimator does it. False: the model had no answer.
bool fly(NonlinearFilter& filter, test::LinearSpace& space, const SensorVector& y, SensorMask fused) {
  return filter.foresee(space, some_sigma()) && filter.update(space, y - filter.predicted(), fused);
}

class EveryNonlinearFilter : public testing::TestWithParam<Row> {
 protected:
  EveryNonlinearFilter() : filter_(GetParam().make()) { filter_->start(OrderVector::Zero(4), some_prior()); }
  test::LinearSpace space_ = some_space();
  std::unique_ptr<NonlinearFilter> filter_;
};

TEST_P(EveryNonlinearFilter, OnALinearModelIsTheKalmanFilter) {
  test::TextbookKalman kalman(space_);
  Flight flight(space_, 5);
  double difference = 0.0, own_sigma = 0.0;
  for (int k = 0; k < 60; ++k) {
    SensorMask fused = all;
    if (k % 7 == 3) fused.reset(static_cast<std::size_t>(k % 3));
    if (k == 20) fused.reset();
    const SensorVector y = flight.measured();
    ASSERT_TRUE(fly(*filter_, space_, y, fused));
    kalman.update(y, fused);
    if (GetParam().exact) {
      ASSERT_TRUE(filter_->estimate().isApprox(kalman.x, 1e-7)) << k;
      ASSERT_TRUE(filter_->covariance().isApprox(kalman.p, 1e-7)) << k;
    } else {
      difference += (filter_->estimate() - kalman.x).squaredNorm();
      own_sigma += kalman.p.trace();
    }
    ASSERT_TRUE(filter_->advance(space_));
    kalman.advance();
    flight.advance();
  }
  // 2000 particles, 500 with own Jacobians: the mean of N draws has P/N_eff beside the truth's own
  if (!GetParam().exact) {
    EXPECT_LT(difference, 0.2 * own_sigma);
  }
}

TEST_P(EveryNonlinearFilter, ErrorsAreWithinTheChiSquareOfItsCovariance) {
  constexpr int flights = 30, samples = 40;
  double nees = 0.0, nis = 0.0;
  int counted = 0;
  for (std::uint64_t seed = 0; seed < flights; ++seed) {
    Flight flight(space_, 100 + seed);
    filter_->start(OrderVector::Zero(4), some_prior());
    for (int k = 0; k < samples; ++k) {
      const SensorVector y = flight.measured();
      ASSERT_TRUE(filter_->foresee(space_, some_sigma()));
      const SensorVector nu = y - filter_->predicted();
      nis += nu.cwiseAbs2().cwiseQuotient(filter_->innovation_variance()).mean();
      ASSERT_TRUE(filter_->update(space_, nu, all));
      const Eigen::VectorXd error = filter_->estimate() - flight.x();
      nees += error.dot(Eigen::MatrixXd(filter_->covariance()).ldlt().solve(error)) / 4.0;
      ++counted;
      ASSERT_TRUE(filter_->advance(space_));
      flight.advance();
    }
  }
  // errors are correlated over some five samples: 240 independent chi-squares of 4, so 1 +- 0.046; the clouds' are those
  // of a finite number of particles. Bounds: 99 percent and what the clouds lack.
  EXPECT_NEAR(nees / counted, 1.0, GetParam().exact ? 0.12 : 0.25);
  EXPECT_NEAR(nis / counted, 1.0, GetParam().exact ? 0.06 : 0.12);
}

TEST_P(EveryNonlinearFilter, TheSameCallsGiveTheSameBitsAndACloneIsANewOne) {
  Flight flight(space_, 9), twin(space_, 9);
  const auto other = filter_->clone();
  other->start(OrderVector::Zero(4), some_prior());
  filter_->start(OrderVector::Zero(4), some_prior());
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(fly(*filter_, space_, flight.measured(), all));
    ASSERT_TRUE(fly(*other, space_, twin.measured(), all));
    ASSERT_EQ(filter_->estimate(), other->estimate());
    ASSERT_EQ(filter_->covariance(), other->covariance());
    filter_->advance(space_);
    other->advance(space_);
    flight.advance();
    twin.advance();
  }
}

TEST_P(EveryNonlinearFilter, WithoutAnAnswerOfTheModelNothingChanges) {
  Flight flight(space_, 3);
  ASSERT_TRUE(fly(*filter_, space_, flight.measured(), all));
  const OrderVector x = filter_->estimate();
  space_.silent = true;
  EXPECT_FALSE(filter_->foresee(space_, some_sigma()));
  EXPECT_EQ(filter_->estimate(), x);
  space_.silent = false;
  EXPECT_TRUE(fly(*filter_, space_, flight.measured(), all));
}

TEST_P(EveryNonlinearFilter, WhatIsNotFusedMayBeNotANumber) {
  Flight flight(space_, 4);
  SensorVector y = flight.measured();
  y(1) = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(fly(*filter_, space_, y, SensorMask(5)));
  EXPECT_TRUE(filter_->estimate().allFinite() && filter_->covariance().allFinite());
}

TEST_P(EveryNonlinearFilter, OpeningMakesItLessCertain) {
  Flight flight(space_, 6);
  ASSERT_TRUE(fly(*filter_, space_, flight.measured(), all));
  ASSERT_TRUE(filter_->advance(space_));
  const auto twin = filter_->clone();
  twin->start(filter_->estimate(), filter_->covariance());
  filter_->open(OrderVector::Constant(4, 9.0));
  ASSERT_TRUE(filter_->foresee(space_, some_sigma()));
  ASSERT_TRUE(twin->foresee(space_, some_sigma()));
  EXPECT_GT(filter_->innovation_variance().minCoeff(), 2.0 * twin->innovation_variance().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Table, EveryNonlinearFilter, testing::ValuesIn(rows()),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
