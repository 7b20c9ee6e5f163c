// SPDX-License-Identifier: Apache-2.0
// One V* for several points: of one point it is that point's, of all health parameters it costs nothing, and no other
// row space tells more of the points' readings.

#include "tuner_design/design/shared_tuners.h"

#include <gtest/gtest.h>

#include "deploy/runtime/numbers/decompositions.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/search/row_space.h"

namespace ehm::tuner_design {
namespace {

using test::Random;

PointReadings readings(std::uint64_t seed, Eigen::Index m, Eigen::Index p, double noise) {
  Random random(seed);
  return {random.normal_matrix(m, p), noise * noise * Eigen::MatrixXd::Identity(m, m)};
}

Eigen::VectorXd spread(Eigen::Index p) {
  Random random(77);
  Eigen::VectorXd sigma(p);
  for (double& s : sigma) s = random.uniform(0.5, 3.0);
  return sigma;
}

/// Mean of the ratios to what each point's own sensors allow.
double mean_ratio(const Eigen::MatrixXd& V, const std::vector<PointReadings>& points, const Eigen::VectorXd& sigma) {
  const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(sigma.size(), sigma.size());
  double sum = 0.0;
  for (const PointReadings& point : points)
    sum += steady_error_on(V, point, sigma) / steady_error_on(all, point, sigma);
  return sum / static_cast<double>(points.size());
}

TEST(SharedTuners, OfOnePointAreItsClosedForm) {
  const PointReadings point = readings(1, 4, 7, 1e-4);
  const Eigen::VectorXd sigma = spread(7);
  const Eigen::MatrixXd shared = shared_tuners({point}, sigma, 4);
  const Eigen::MatrixXd closed = closed_form_tuners(point.H, point.noise, sigma, 4);
  EXPECT_LT((shared.transpose() * shared - closed.transpose() * closed).norm(), 1e-6);
}

TEST(SharedTuners, OnAllHealthParametersTheErrorIsTheConditionalCovariance) {
  const PointReadings point = readings(2, 4, 7, 0.1);
  const Eigen::VectorXd sigma = spread(7);
  const Eigen::MatrixXd information = Eigen::MatrixXd(sigma.cwiseAbs2().cwiseInverse().asDiagonal()) +
                                      point.H.transpose() * point.noise.inverse() * point.H;
  EXPECT_NEAR(steady_error_on(Eigen::MatrixXd::Identity(7, 7), point, sigma),
              information.llt().solve(Eigen::MatrixXd::Identity(7, 7)).trace(), 1e-10);
}

TEST(SharedTuners, CostLessTheMoreThereAreAndLessThanOnePointsOwn) {
  const std::vector<PointReadings> points{readings(3, 4, 9, 0.01), readings(4, 4, 9, 0.01), readings(5, 4, 9, 0.01)};
  const Eigen::VectorXd sigma = Eigen::VectorXd::Constant(9, 2.0);
  double before = mean_ratio(shared_tuners({points[0]}, sigma, 4), points, sigma);
  for (Eigen::Index t = 4; t <= 9; ++t) {
    const double now = mean_ratio(shared_tuners(points, sigma, t), points, sigma);
    EXPECT_LT(now, before) << t;
    EXPECT_GE(now, 1.0 - 1e-12) << t;
    before = now;
  }
  EXPECT_NEAR(before, 1.0, 1e-9);
}

TEST(SharedTuners, AHeavierPointIsServedBetter) {
  std::vector<PointReadings> points{readings(6, 3, 7, 0.01), readings(7, 3, 7, 0.01)};
  const Eigen::VectorXd sigma = Eigen::VectorXd::Constant(7, 2.0);
  const double even = steady_error_on(shared_tuners(points, sigma, 3), points[0], sigma);
  points[0].weight = 9.0;
  EXPECT_LT(steady_error_on(shared_tuners(points, sigma, 3), points[0], sigma), even);
}

TEST(SharedTuners, AWrongNumberIsNamed) {
  const std::vector<PointReadings> points{readings(8, 3, 5, 0.1)};
  EXPECT_THROW(shared_tuners(points, spread(5), 6), std::invalid_argument);
  EXPECT_THROW(shared_tuners({}, spread(5), 3), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::tuner_design
