// SPDX-License-Identifier: Apache-2.0
// The nearest point of a box: against every active set tried in turn, by its optimality conditions, and at the edges.

#include "monitor/estimation/constrained/box_projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::estimation {
namespace {

using test::Random;
constexpr double infinite = std::numeric_limits<double>::infinity();

struct Problem {
  HealthCovariance P;
  HealthVector x, lower, upper;
};

/// Correlated and badly scaled; some bounds infinite, xhat inside and outside.
Problem seeded(Eigen::Index p, std::uint64_t seed) {
  Random random(seed);
  const Eigen::MatrixXd root = random.normal_matrix(p, p);
  Eigen::VectorXd scale(p);
  for (double& s : scale) s = std::pow(10.0, random.uniform(-2.0, 1.0));
  Problem problem;
  problem.P = scale.asDiagonal() * (root * root.transpose()) * scale.asDiagonal();
  problem.x = 2.0 * scale.cwiseProduct(random.normal_vector(p));
  const Eigen::VectorXd centre = scale.cwiseProduct(random.normal_vector(p));
  problem.lower = centre - scale.cwiseProduct(random.normal_vector(p).cwiseAbs());
  problem.upper = centre + scale.cwiseProduct(random.normal_vector(p).cwiseAbs());
  for (Eigen::Index i = 0; i < p; ++i) {
    if (random.uniform(0.0, 1.0) < 0.25) problem.lower(i) = -infinite;
    if (random.uniform(0.0, 1.0) < 0.25) problem.upper(i) = infinite;
  }
  return problem;
}

double cost(const Problem& problem, const Eigen::VectorXd& x) {
  const Eigen::VectorXd away = x - problem.x;
  return away.dot(Eigen::MatrixXd(problem.P).fullPivLu().solve(away));
}

/// The least cost over all 3^p choices of free, at the lower, at the upper bound, by W = P^-1 and its own solves.
Eigen::VectorXd by_enumeration(const Problem& problem) {
  const Eigen::Index p = problem.x.size();
  const Eigen::MatrixXd W = Eigen::MatrixXd(problem.P).fullPivLu().inverse();
  Eigen::VectorXd best;
  double least = infinite;
  int choices = 1;
  for (Eigen::Index i = 0; i < p; ++i) choices *= 3;
  for (int choice = 0; choice < choices; ++choice) {
    Eigen::VectorXd x = problem.x;
    std::vector<Eigen::Index> free, fixed;
    bool finite = true;
    for (Eigen::Index i = 0, rest = choice; i < p; ++i, rest /= 3) {
      if (rest % 3 == 0) {
        free.push_back(i);
        continue;
      }
      fixed.push_back(i);
      x(i) = rest % 3 == 1 ? problem.lower(i) : problem.upper(i);
      finite = finite && std::isfinite(x(i));
    }
    if (!finite) continue;
    if (!free.empty() && !fixed.empty()) {
      const Eigen::VectorXd away = x(fixed) - problem.x(fixed);
      x(free) = problem.x(free) - Eigen::MatrixXd(W(free, free)).fullPivLu().solve(W(free, fixed) * away);
    }
    const double slack = 1e-9 * (1.0 + x.cwiseAbs().maxCoeff());
    if ((x.array() < problem.lower.array() - slack).any() || (x.array() > problem.upper.array() + slack).any())
      continue;
    if (const double c = cost(problem, x); c < least) {
      least = c;
      best = x;
    }
  }
  return best;
}

TEST(BoxProjection, IsTheBestOfAllActiveSets) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Problem problem = seeded(1 + static_cast<Eigen::Index>(seed % 6), seed);
    HealthVector x = problem.x;
    ASSERT_EQ(project_onto_box(problem.P, problem.lower, problem.upper, x), BoxSolution::found) << seed;
    const Eigen::VectorXd best = by_enumeration(problem);
    ASSERT_EQ(best.size(), x.size()) << seed;
    EXPECT_NEAR(cost(problem, x), cost(problem, best), 1e-6 * (1.0 + cost(problem, best))) << seed;
    EXPECT_LT((x - best).cwiseAbs().cwiseQuotient(problem.P.diagonal().cwiseSqrt()).maxCoeff(), 1e-6) << seed;
  }
}

// mu = P^-1 (x - xhat): zero where x is free, at least 0 at a lower bound, at most 0 at an upper one.
TEST(BoxProjection, MeetsTheOptimalityConditions) {
  for (std::uint64_t seed = 100; seed < 400; ++seed) {
    const Problem problem = seeded(seed % 2 == 0 ? 10 : max_health, seed);
    HealthVector x = problem.x;
    ASSERT_EQ(project_onto_box(problem.P, problem.lower, problem.upper, x), BoxSolution::found) << seed;
    EXPECT_TRUE((x.array() >= problem.lower.array()).all() && (x.array() <= problem.upper.array()).all()) << seed;
    // in standard deviations
    const Eigen::VectorXd sigma = problem.P.diagonal().cwiseSqrt();
    const Eigen::MatrixXd correlation =
        sigma.cwiseInverse().asDiagonal() * Eigen::MatrixXd(problem.P) * sigma.cwiseInverse().asDiagonal();
    const Eigen::VectorXd mu =
        correlation.fullPivLu().solve(Eigen::VectorXd(Eigen::VectorXd(x - problem.x).cwiseQuotient(sigma)));
    const double rounding = 1e-7 * (1.0 + mu.cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      EXPECT_TRUE(x(i) == problem.lower(i) || mu(i) < rounding) << seed << ", " << i << ": " << mu(i);
      EXPECT_TRUE(x(i) == problem.upper(i) || mu(i) > -rounding) << seed << ", " << i << ": " << mu(i);
    }
  }
}

TEST(BoxProjection, LeavesWhatIsInsideToTheBit) {
  Problem problem = seeded(5, 3);
  problem.lower.setConstant(-infinite);
  problem.upper = problem.x;
  HealthVector x = problem.x;
  EXPECT_EQ(project_onto_box(problem.P, problem.lower, problem.upper, x), BoxSolution::found);
  EXPECT_EQ(x, problem.x);
}

TEST(BoxProjection, WithoutCorrelationIsTheClamp) {
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    Problem problem = seeded(8, seed);
    problem.P = problem.P.diagonal().asDiagonal().toDenseMatrix();
    HealthVector x = problem.x;
    ASSERT_EQ(project_onto_box(problem.P, problem.lower, problem.upper, x), BoxSolution::found);
    EXPECT_EQ(x, clamped_to_box(problem.x, problem.lower, problem.upper));
  }
}

// P of rank 1: the parameters move together, and only along (1, 2).
TEST(BoxProjection, WithASingularCovarianceGoesAlongItOrSaysThatItCannot) {
  HealthCovariance P(2, 2);
  P << 1.0, 2.0, 2.0, 4.0;
  HealthVector lower(2), upper(2), x(2);
  lower << -infinite, -infinite;
  upper << -1.0, infinite;
  x << 0.5, 1.0;
  EXPECT_EQ(project_onto_box(P, lower, upper, x), BoxSolution::found);
  EXPECT_NEAR(x(0), -1.0, 1e-15);
  EXPECT_NEAR(x(1), -2.0, 1e-15);
  upper << -1.0, infinite;
  lower << -infinite, 0.5;
  HealthVector stays(2);
  stays << 0.5, 1.0;
  x = stays;
  EXPECT_EQ(project_onto_box(P, lower, upper, x), BoxSolution::infeasible);
  EXPECT_EQ(x, stays);
}

TEST(BoxProjection, RefusesWhatIsNoBoxAndWhatIsNoNumber) {
  Problem problem = seeded(3, 7);
  HealthVector x = problem.x;
  problem.lower(1) = 2.0;
  problem.upper(1) = 1.0;
  EXPECT_EQ(project_onto_box(problem.P, problem.lower, problem.upper, x), BoxSolution::infeasible);
  problem.lower(1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(project_onto_box(problem.P, problem.lower, problem.upper, x), BoxSolution::infeasible);
  problem = seeded(3, 7);
  problem.x(0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(project_onto_box(problem.P, problem.lower, problem.upper, problem.x), BoxSolution::infeasible);
}

TEST(BoxProjection, AllocatesNothing) {
  const Problem problem = seeded(max_health, 9);
  HealthVector x = problem.x;
  const long before = test::allocation_count();
  EXPECT_EQ(project_onto_box(problem.P, problem.lower, problem.upper, x), BoxSolution::found);
  x = clamped_to_box(problem.x, problem.lower, problem.upper);
  EXPECT_EQ(test::allocation_count() - before, 0);
}

}  // namespace
}  // namespace ehm::estimation
