// SPDX-License-Identifier: Apache-2.0
// A Gaussian inside a box: closed forms in one dimension, the far tail by its series, rejection in two and three.

#include "monitor/estimation/constrained/truncated_gaussian.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "deploy/runtime/numbers/decompositions.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::estimation {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double density(double u) {
  return std::isinf(u) ? 0.0 : std::exp(-0.5 * u * u) / std::sqrt(2.0 * std::numbers::pi);
}

/// Above.
double mass(double u) {
  return 0.5 * std::erfc(u / std::numbers::sqrt2);
}

/// Johnson, Kotz & Balakrishnan, Continuous Univariate Distributions 1, section 13.10.1: differences of error
/// functions.
TruncatedMoments closed_form(double low, double high) {
  const double z = mass(low) - mass(high), mean = (density(low) - density(high)) / z;
  const double edges = (std::isinf(low) ? 0.0 : low * density(low)) - (std::isinf(high) ? 0.0 : high * density(high));
  return {mean, 1.0 + edges / z - mean * mean};
}

TEST(TruncatedGaussian, OfOneCoordinateIsTheClosedForm) {
  for (const auto& [low, high] : {std::pair{0.0, infinite},
                                  {-1.0, 2.0},
                                  {-8.0, 0.5},
                                  {-infinite, -1.0},
                                  {1.0, 3.0},
                                  {-0.3, 0.1},
                                  {-infinite, 4.0},
                                  {2.0, infinite}}) {
    const TruncatedMoments ours = truncated_moments(low, high), known = closed_form(low, high);
    EXPECT_NEAR(ours.mean, known.mean, 1e-13) << low << " " << high;
    EXPECT_NEAR(ours.variance, known.variance, 1e-12) << low << " " << high;
  }
  // half a Gaussian: sqrt(2/pi), 1 - 2/pi
  EXPECT_NEAR(truncated_moments(0.0, infinite).mean, std::sqrt(2.0 / std::numbers::pi), 1e-15);
  EXPECT_NEAR(truncated_moments(0.0, infinite).variance, 1.0 - 2.0 / std::numbers::pi, 1e-15);
}

TEST(TruncatedGaussian, OfTheWholeLineAndOfAPointIsThat) {
  EXPECT_EQ(truncated_moments(-infinite, infinite).mean, 0.0);
  EXPECT_EQ(truncated_moments(-infinite, infinite).variance, 1.0);
  EXPECT_NEAR(truncated_moments(-8.8, 8.8).variance, 1.0, 1e-14);
  EXPECT_EQ(truncated_moments(1.5, 1.5).mean, 1.5);
  EXPECT_EQ(truncated_moments(1.5, 1.5).variance, 0.0);
}

// One-sided, low = a: mean a + 1/a - 2/a^3 + 10/a^5, variance 1/a^2 - 6/a^4 + 50/a^6 (asymptotic series of Mills'
// ratio).
TEST(TruncatedGaussian, HoldsInTheFarTail) {
  for (const double a : {1e2, 1e4, 1e6, 1e8}) {
    const TruncatedMoments tail = truncated_moments(a, infinite), other = truncated_moments(-infinite, -a);
    EXPECT_NEAR(tail.mean / (a + 1.0 / a - 2.0 / (a * a * a)), 1.0, 1e-11) << a;
    EXPECT_NEAR(tail.variance * a * a, 1.0 - 6.0 / (a * a) + 50.0 / (a * a * a * a), 1e-9) << a;
    EXPECT_EQ(other.mean, -tail.mean);
    EXPECT_EQ(other.variance, tail.variance);
  }
  // so narrow that it is uniform, there
  const TruncatedMoments narrow = truncated_moments(50.0, 50.0 + 1e-7);
  EXPECT_NEAR((narrow.mean - 50.0) / 1e-7, 0.5, 1e-5);
  EXPECT_NEAR(narrow.variance / 1e-14, 1.0 / 12.0, 1e-6);
}

TEST(TruncatedGaussian, TheOthersMoveAsTheyAreCorrelated) {
  // Given x_0 alone everything is exact: x_1 moves by its regression on x_0, and keeps its own rest.
  HealthVector x(2), lower(2), upper(2);
  HealthCovariance P(2, 2);
  x << 1.0, 5.0;
  P << 4.0, 3.0, 3.0, 9.0;
  lower << -infinite, -infinite;
  upper << 0.0, infinite;
  const TruncatedMoments u = closed_form(-infinite, -0.5);
  ASSERT_TRUE(truncate_to_box(lower, upper, x, P));
  EXPECT_NEAR(x(0), 1.0 + 2.0 * u.mean, 1e-12);
  EXPECT_NEAR(x(1), 5.0 + 1.5 * u.mean, 1e-12);
  EXPECT_NEAR(P(0, 0), 4.0 * u.variance, 1e-12);
  EXPECT_NEAR(P(0, 1), 3.0 * u.variance, 1e-12);
  EXPECT_NEAR(P(1, 1), 9.0 - (1.0 - u.variance) * 9.0 / 4.0, 1e-12);
  EXPECT_EQ(P(0, 1), P(1, 0));
}

struct Sampled {
  Eigen::VectorXd mean, sigma;
};

/// By rejection.
Sampled sampled(const Eigen::VectorXd& x, const Eigen::MatrixXd& P, const Eigen::VectorXd& lower,
                const Eigen::VectorXd& upper, int draws) {
  test::Random random(5);
  const Eigen::MatrixXd root = P.llt().matrixL();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(x.size()), squares = sum;
  int kept = 0;
  for (int k = 0; k < draws; ++k) {
    const Eigen::VectorXd one = x + root * random.normal_vector(x.size());
    if ((one.array() < lower.array()).any() || (one.array() > upper.array()).any()) continue;
    ++kept;
    sum += one;
    squares += one.cwiseAbs2();
  }
  const Eigen::VectorXd mean = sum / kept;
  return {mean, (squares / kept - mean.cwiseAbs2()).cwiseSqrt()};
}

// 60 000 draws of which some 10 000 stay: mean to 0.01 sigma, sigma to 0.7 %, times 4. Two weakly correlated
// coordinates (0.2) of which each cuts the other's Gaussian: the order costs less than that.
TEST(TruncatedGaussian, InTwoAndThreeDimensionsIsWhatRejectionGives) {
  for (const Eigen::Index p : {2, 3}) {
    Eigen::MatrixXd P = Eigen::MatrixXd::Constant(p, p, 0.2);
    P.diagonal().setOnes();
    Eigen::VectorXd x = Eigen::VectorXd::Constant(p, 0.5), lower = Eigen::VectorXd::Constant(p, -2.0),
                    upper = Eigen::VectorXd::Zero(p);
    const Sampled known = sampled(x, P, lower, upper, p == 2 ? 60000 : 150000);
    HealthVector mean = x;
    HealthCovariance inside = P;
    ASSERT_TRUE(truncate_to_box(lower, upper, mean, inside));
    for (Eigen::Index i = 0; i < p; ++i) {
      EXPECT_NEAR(mean(i), known.mean(i), 0.04) << p << ", " << i;
      EXPECT_NEAR(std::sqrt(inside(i, i)), known.sigma(i), 0.03) << p << ", " << i;
    }
  }
}

TEST(TruncatedGaussian, StaysSemidefiniteAndInsideForAnyBox) {
  for (std::uint64_t seed = 1; seed < 100; ++seed) {
    test::Random random(seed);
    const Eigen::MatrixXd root = random.normal_matrix(10, 10);
    HealthCovariance P = root * root.transpose();
    HealthVector x = 3.0 * random.normal_vector(10), lower = HealthVector::Constant(10, -infinite);
    HealthVector upper = random.normal_vector(10);
    ASSERT_TRUE(truncate_to_box(lower, upper, x, P));
    EXPECT_LT(x(9), upper(9));  // the last one taken
    EXPECT_GT(Eigen::MatrixXd(P).selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-10) << seed;
  }
}

TEST(TruncatedGaussian, RefusesWhatIsNoBoxAndKeepsWhatIsKnown) {
  HealthVector x = HealthVector::Ones(2), lower = HealthVector::Zero(2), upper = HealthVector::Constant(2, -1.0);
  HealthCovariance P = HealthCovariance::Identity(2, 2);
  EXPECT_FALSE(truncate_to_box(lower, upper, x, P));
  EXPECT_EQ(x, HealthVector::Ones(2));
  upper.setConstant(0.5);
  P(0, 0) = 0.0;
  EXPECT_TRUE(truncate_to_box(lower, upper, x, P));
  EXPECT_EQ(x(0), 1.0);
  EXPECT_LT(x(1), 0.5);
}

TEST(TruncatedGaussian, AllocatesNothing) {
  HealthVector x = HealthVector::Ones(10);
  const HealthVector lower = HealthVector::Constant(10, -1.0), upper = HealthVector::Zero(10);
  HealthCovariance P = HealthCovariance::Identity(10, 10);
  const long before = test::allocation_count();
  EXPECT_TRUE(truncate_to_box(lower, upper, x, P));
  EXPECT_EQ(test::allocation_count() - before, 0);
}

}  // namespace
}  // namespace ehm::estimation
