// SPDX-License-Identifier: Apache-2.0
#include "monitor/nonlinear/sigma_points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using ehm::nonlinear::sigma_points;
using ehm::nonlinear::SigmaOptions;
using ehm::nonlinear::SigmaPoints;
using ehm::nonlinear::SigmaSet;

class EverySet : public testing::TestWithParam<SigmaSet> {};

TEST_P(EverySet, HasMeanZeroAndCovarianceOneInAnyDimension) {
  for (const Eigen::Index d : {1, 2, 3, 7, 12, 24}) {
    for (const double alpha : {0.0, 0.3, 1.0}) {
      SigmaOptions options{.set = GetParam(), .kappa = 0.5, .centre_weight = 0.2, .alpha = alpha};
      const SigmaPoints s = sigma_points(d, options);
      ASSERT_EQ(s.points.rows(), d);
      EXPECT_EQ(s.points.cols(), GetParam() == SigmaSet::symmetric ? 2 * d + 1 : d + 2);
      // the weights of the minimal skew set are of the size of 2^d: what is lost of 16 digits grows with it
      const double exact = 1e-15 * s.mean_weights.cwiseAbs().maxCoeff() * static_cast<double>(d) + 1e-12;
      EXPECT_NEAR(s.mean_weights.sum(), 1.0, exact);
      EXPECT_LT((s.points * s.mean_weights).norm(), exact * s.points.norm());
      const Eigen::MatrixXd covariance = s.points * s.mean_weights.asDiagonal() * s.points.transpose();
      EXPECT_LT((covariance - Eigen::MatrixXd::Identity(d, d)).norm(), 1e-9) << d << ' ' << alpha;
      EXPECT_TRUE(s.points.col(0).isZero());
    }
  }
}

TEST_P(EverySet, ReachesAsFarAsAsked) {
  const SigmaPoints s = sigma_points(12, {.set = GetParam()});
  EXPECT_NEAR(s.points.colwise().norm().maxCoeff(), std::sqrt(3.0), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Sets, EverySet,
                         testing::Values(SigmaSet::symmetric, SigmaSet::spherical_simplex, SigmaSet::minimal_skew));

TEST(SigmaPointsTest, SymmetricWeightsAreThoseOfTheScaledTransform) {
  // Wan & van der Merwe 2000: lambda = a^2 (n + k) - n, W0m = lambda/(n + lambda), W0c = W0m + 1 - a^2 + b
  const double n = 5, a = 0.4, k = -1.0, b = 2.0, lambda = a * a * (n + k) - n;
  const SigmaPoints s = sigma_points(5, {.kappa = k, .alpha = a, .beta = b});
  EXPECT_NEAR(s.mean_weights(0), lambda / (n + lambda), 1e-12);
  EXPECT_NEAR(s.covariance_weights(0), lambda / (n + lambda) + 1.0 - a * a + b, 1e-12);
  EXPECT_NEAR(s.mean_weights(3), 0.5 / (n + lambda), 1e-12);
  EXPECT_NEAR(s.points(0, 1), std::sqrt(n + lambda), 1e-12);
}

TEST(SigmaPointsTest, SphericalPointsLieOnASphere) {
  // Julier 2003: radius sqrt(n/(1 - W0)), but for the centre
  const SigmaPoints s = sigma_points(7, {.set = SigmaSet::spherical_simplex, .centre_weight = 0.3, .alpha = 1.0});
  for (Eigen::Index i = 1; i < s.points.cols(); ++i) EXPECT_NEAR(s.points.col(i).norm(), std::sqrt(7.0 / 0.7), 1e-12);
}

TEST(SigmaPointsTest, ThesisPrintsASimplexWhoseMeanIsNotZero) {
  // [E] has 1 for j in the new point: in two dimensions the last one is 1/sqrt(6 W1), the mean off by 1/sqrt(6 W1) W1
  const SigmaPoints s = sigma_points(2, {.set = SigmaSet::spherical_simplex, .alpha = 1.0});
  Eigen::MatrixXd printed = s.points;
  printed(1, 3) /= 2.0;
  EXPECT_GT((printed * s.mean_weights).norm(), 0.2);
}

TEST(SigmaPointsTest, RefusesWhatHasNoSet) {
  EXPECT_THROW(sigma_points(0, {}), std::invalid_argument);
  EXPECT_THROW(sigma_points(3, {.kappa = -3.0}), std::invalid_argument);
  EXPECT_THROW(sigma_points(3, {.set = SigmaSet::spherical_simplex, .centre_weight = 1.0}), std::invalid_argument);
  EXPECT_THROW(sigma_points(3, {.alpha = -1.0}), std::invalid_argument);
}

}  // namespace
