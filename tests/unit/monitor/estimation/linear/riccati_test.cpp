// SPDX-License-Identifier: Apache-2.0
// Riccati and Lyapunov solvers: numbers of scipy (fixtures/scipy_reference.json says how they were made), and what must
// hold for any solution: residual, symmetry, definiteness, stability.

#include "monitor/estimation/linear/riccati.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::tuner_design {
namespace {

using test::Random;

nlohmann::json scipy_reference() {
  std::ifstream stream(std::string(EHM_SOURCE_DIR) + "/tests/unit/tuner_design/fixtures/scipy_reference.json");
  return nlohmann::json::parse(stream);
}

Eigen::MatrixXd matrix(const nlohmann::json& rows) {
  Eigen::MatrixXd result(rows.size(), rows.at(0).size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < rows[i].size(); ++j) {
      result(as_index(i), as_index(j)) = rows[i][j].get<double>();
    }
  }
  return result;
}

double least_eigenvalue(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues().minCoeff();
}

Eigen::MatrixXd positive_definite(Random& random, Eigen::Index size) {
  const Eigen::MatrixXd factor = random.normal_matrix(size, size);
  return factor * factor.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
}

TEST(Riccati, AgreesWithScipy) {
  const nlohmann::json reference = scipy_reference();
  ASSERT_EQ(reference.at("riccati").size(), 5U);
  for (const auto& problem : reference.at("riccati")) {
    SCOPED_TRACE(problem.at("name").get<std::string>());
    const Eigen::MatrixXd A = matrix(problem.at("A")), C = matrix(problem.at("C"));
    const Eigen::MatrixXd Q = matrix(problem.at("Q")), R = matrix(problem.at("R")), expected = matrix(problem.at("P"));
    const Eigen::MatrixXd P = estimation::solve_filter_riccati(A, C, Q, R);
    EXPECT_LT((P - expected).norm() / expected.norm(), 1e-9);
    // Ours is the more exact of the two (theory.md, section 10: SDA 1e-15, SLICOT up to 1e-12).
    EXPECT_LE(estimation::riccati_residual(P, A, C, Q, R),
              std::max(1e-14, 1.01 * estimation::riccati_residual(expected, A, C, Q, R)));
  }
}

TEST(Riccati, RandomProblemsSolveTheEquationAndStabilise) {
  Random random(1);
  for (int problem = 0; problem < 200; ++problem) {
    SCOPED_TRACE(problem);
    const auto n = static_cast<Eigen::Index>(random.uniform(1, 12)),
               m = static_cast<Eigen::Index>(random.uniform(1, 8));
    Eigen::MatrixXd A = random.normal_matrix(n, n);
    A *= random.uniform(0.5, 1.1) / estimation::spectral_radius(A);  // stable and unstable ones
    const Eigen::MatrixXd C = random.normal_matrix(m, n);
    const Eigen::MatrixXd Q = positive_definite(random, n), R = positive_definite(random, m);
    const Eigen::MatrixXd P = estimation::solve_filter_riccati(A, C, Q, R);
    EXPECT_LT(estimation::riccati_residual(P, A, C, Q, R), 1e-10);
    EXPECT_EQ((P - P.transpose()).norm(), 0.0);
    EXPECT_GT(least_eigenvalue(P), 0.0);
    const Eigen::MatrixXd K = (C * P * C.transpose() + R).llt().solve(C * P).transpose();
    EXPECT_LT(estimation::spectral_radius(A - A * K * C), 1.0);
  }
}

TEST(Riccati, SolvesWhatNoiseOfAnySizeLeaves) {
  // p = a^2 p r / (p + r) + q has the positive root of p^2 + (r - a^2 r - q) p - q r = 0; one such equation a state,
  // mixed by an orthogonal T, which takes the sensors' noise through 14 decades.
  Random random(3);
  const Eigen::MatrixXd T = Eigen::HouseholderQR<Eigen::MatrixXd>(random.normal_matrix(6, 6)).householderQ();
  const Eigen::VectorXd a = (Eigen::VectorXd(6) << 0.95, 0.9, 1.0, 1.0, 1.0, 1.0).finished();
  const Eigen::VectorXd q = (Eigen::VectorXd(6) << 1e-4, 1e-4, 1e-3, 1e-3, 1e-3, 1e-3).finished();
  for (const double scale : {1.0, 1e-4, 1e-8, 1e-10, 1e-12}) {
    SCOPED_TRACE(scale);
    Eigen::VectorXd r(6), p(6);
    for (Eigen::Index i = 0; i < 6; ++i) {
      r(i) = scale * std::pow(10.0, -0.5 * static_cast<double>(i));
      const double b = r(i) - a(i) * a(i) * r(i) - q(i);
      p(i) = b > 0.0 ? 2.0 * q(i) * r(i) / (b + std::sqrt(b * b + 4.0 * q(i) * r(i)))
                     : 0.5 * (-b + std::sqrt(b * b + 4.0 * q(i) * r(i)));
    }
    const Eigen::MatrixXd P = estimation::solve_filter_riccati(T * a.asDiagonal() * T.transpose(), T.transpose(),
                                                               T * q.asDiagonal() * T.transpose(), r.asDiagonal());
    const Eigen::MatrixXd expected = T * p.asDiagonal() * T.transpose();
    EXPECT_LT((P - expected).norm() / expected.norm(), 1e-9);
  }
}

TEST(Riccati, ScalarHasItsClosedForm) {
  // p = a^2 p r / (p + r) + q with a = c = 1, q = r = 1: p^2 = p + 1, the golden ratio.
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  EXPECT_NEAR(estimation::solve_filter_riccati(one, one, one, one)(0, 0), (1.0 + std::sqrt(5.0)) / 2.0, 1e-14);
}

TEST(Riccati, RefusesWhatHasNoSolution) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1), none = Eigen::MatrixXd::Zero(1, 1);
  EXPECT_THROW(estimation::solve_filter_riccati(2.0 * one, none, one, one), std::runtime_error)
      << "unstable and not seen";
  EXPECT_THROW(estimation::solve_filter_riccati(one, one, none, one), std::runtime_error)
      << "integrator that nothing drives";
  try {
    estimation::solve_filter_riccati(one, one, one, none);
    FAIL() << "R = 0 was accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "Riccati equation: R is not positive definite");
  }
  EXPECT_THROW(estimation::solve_filter_riccati(one, Eigen::MatrixXd::Ones(1, 2), one, one), std::invalid_argument);
}

TEST(Lyapunov, AgreesWithScipy) {
  const nlohmann::json reference = scipy_reference();
  ASSERT_FALSE(reference.at("lyapunov").empty());
  for (const auto& problem : reference.at("lyapunov")) {
    SCOPED_TRACE(problem.at("name").get<std::string>());
    const Eigen::MatrixXd expected = matrix(problem.at("X"));
    const Eigen::MatrixXd X = estimation::solve_discrete_lyapunov(matrix(problem.at("A")), matrix(problem.at("Q")));
    EXPECT_LT((X - expected).norm() / expected.norm(), 1e-10);
  }
}

TEST(Lyapunov, RandomProblemsSolveTheEquation) {
  Random random(2);
  for (int problem = 0; problem < 200; ++problem) {
    SCOPED_TRACE(problem);
    const auto n = static_cast<Eigen::Index>(random.uniform(1, 12));
    Eigen::MatrixXd A = random.normal_matrix(n, n);
    A *= random.uniform(0.1, 0.999) / estimation::spectral_radius(A);
    const Eigen::MatrixXd Q = positive_definite(random, n);
    const Eigen::MatrixXd X = estimation::solve_discrete_lyapunov(A, Q);
    EXPECT_LT((A * X * A.transpose() + Q - X).norm() / X.norm(), 1e-12);
    EXPECT_EQ((X - X.transpose()).norm(), 0.0);
    EXPECT_GT(least_eigenvalue(X), 0.0);
  }
}

TEST(Lyapunov, RefusesAnUnstableMatrix) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  try {
    estimation::solve_discrete_lyapunov(one, one);
    FAIL() << "an integrator was accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "Lyapunov equation: A has the spectral radius 1, allowed below 1");
  }
  EXPECT_THROW(estimation::solve_discrete_lyapunov(one, Eigen::MatrixXd::Ones(2, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::tuner_design
