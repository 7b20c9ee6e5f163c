// SPDX-License-Identifier: Apache-2.0
// MAP estimators, Bayes limit and observability on models that are made up here.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/runtime/numbers/decompositions.h"
#include "engine_sim/linear_model/scaling.h"
#include "monitor/estimation/steady_gain.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/theory/bayes_limit.h"
#include "tuner_design/theory/map_estimator.h"
#include "tuner_design/theory/observability.h"

namespace ehm::tuner_design {
namespace {

using test::Random;

struct Snapshot {
  Eigen::MatrixXd H, Ph, R;
};

Snapshot random_snapshot(std::uint64_t seed, Eigen::Index m, Eigen::Index p) {
  Random random(seed);
  Snapshot snapshot{random.normal_matrix(m, p), Eigen::MatrixXd::Zero(p, p), Eigen::MatrixXd::Zero(m, m)};
  for (Eigen::Index i = 0; i < p; ++i) snapshot.Ph(i, i) = random.uniform(0.5, 5.0);
  for (Eigen::Index i = 0; i < m; ++i) snapshot.R(i, i) = random.uniform(0.05, 0.6);
  return snapshot;
}

TEST(MapEstimator, FullOrderErrorIsTheConditionalCovariance) {
  // Bayes: posterior = (Ph^-1 + H^T R^-1 H)^-1, by another route than the gain.
  const Snapshot s = random_snapshot(3, 4, 7);
  const Eigen::MatrixXd information =
      s.Ph.llt().solve(Eigen::MatrixXd::Identity(7, 7)) + s.H.transpose() * s.R.llt().solve(s.H);
  const Eigen::MatrixXd posterior = information.llt().solve(Eigen::MatrixXd::Identity(7, 7));
  const Eigen::MatrixXd error = snapshot_error_covariance(full_map_gain(s.H, s.Ph, s.R), s.H, s.Ph, s.R);
  EXPECT_LT((error - posterior).norm() / posterior.norm(), 1e-12);
}

Eigen::MatrixXd reduced_error(const Snapshot& s, const Eigen::MatrixXd& V) {
  return snapshot_error_covariance(reduced_map_gain(s.H, s.Ph, s.R, V), s.H, s.Ph, s.R);
}

TEST(MapEstimator, ReducedOnHPhLosesNothingAndOtherTunersLose) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Snapshot s = random_snapshot(seed, 4, 7);
    s.Ph.setIdentity();  // equal spread of all health parameters, in units of that spread
    const Eigen::MatrixXd full = snapshot_error_covariance(full_map_gain(s.H, s.Ph, s.R), s.H, s.Ph, s.R);
    EXPECT_LT((reduced_error(s, s.H * s.Ph) - full).norm() / full.norm(), 1e-10);
    Random random(seed + 1000);
    EXPECT_GT(reduced_error(s, random.normal_matrix(4, 7)).trace(), full.trace());
  }
}

TEST(MapEstimator, UnequalSpreadCostsTheReducedEstimatorVeryLittle) {
  // W = V^+ is E[h | q] only where Ph is a multiple of I; otherwise the prior of q is not quite that of the sensors.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const Snapshot s = random_snapshot(seed, 4, 7);
    const double full = snapshot_error_covariance(full_map_gain(s.H, s.Ph, s.R), s.H, s.Ph, s.R).trace();
    const double reduced = reduced_error(s, s.H * s.Ph).trace();
    EXPECT_GT(reduced, full);
    EXPECT_LT(reduced, 1.01 * full);
  }
}

TEST(MapEstimator, RankDeficientTunersAreRefused) {
  const Snapshot s = random_snapshot(5, 3, 5);
  Eigen::MatrixXd V = s.H;
  V.row(2) = V.row(0);
  try {
    reduced_map_gain(s.H, s.Ph, s.R, V);
    FAIL() << "two equal rows were accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "tuner matrix V has rank 2, expected 3");
  }
}

TEST(BayesLimit, IsTheFormulaAndTheLimitOfSmallNoise) {
  const Snapshot s = random_snapshot(6, 4, 7);
  const Eigen::MatrixXd HPh = s.H * s.Ph;
  const Eigen::MatrixXd formula = s.Ph - HPh.transpose() * (HPh * s.H.transpose()).llt().solve(HPh);
  const Eigen::MatrixXd factor = bayes_limit_factor(s.H, s.Ph);
  const Eigen::MatrixXd limit = factor * factor.transpose();
  EXPECT_EQ(factor.cols(), 3);
  EXPECT_LT((limit - formula).norm(), 1e-12);
  const Eigen::MatrixXd small = 1e-10 * s.R;
  const Eigen::MatrixXd map = snapshot_error_covariance(full_map_gain(s.H, s.Ph, small), s.H, s.Ph, small);
  EXPECT_LT((limit - map).norm(), 1e-6);
  EXPECT_LT((s.H * limit).norm(), 1e-12) << "what the sensors see is known";
}

TEST(BayesLimit, IsZeroWhereSensorsSeeEverything) {
  const Snapshot s = random_snapshot(7, 9, 5);
  EXPECT_EQ(bayes_limit_factor(s.H, s.Ph).size(), 0);
}

Observability observability_of(const linear_model::LinearModel& model) {
  const linear_model::LinearModel scaled = linear_model::scaled(model, linear_model::scaling_of(model));
  return steady_observability(scaled, estimation::steady_gain(scaled).H);
}

TEST(ObservabilityTest, NamesSensorsThatRepeatEachOther) {
  linear_model::LinearModel model = test::made_up_model(4, 6);
  for (Eigen::MatrixXd* matrix : {&model.C, &model.M}) matrix->row(3) = 0.5 * matrix->row(2);
  EXPECT_EQ(rank_note(observability_of(model), true),
            "sensors {y2, y3} repeat each other in the steady state: 3 combinations of health are seen, of 4");
  EXPECT_EQ(design_tuner(model, {}).full.V.rows(), 3);
}

TEST(ObservabilityTest, NamesHealthParametersThatLookAlike) {
  linear_model::LinearModel model = test::made_up_model(6, 4);
  for (Eigen::MatrixXd* matrix : {&model.L, &model.M}) matrix->col(3) = -2.0 * matrix->col(1);
  EXPECT_EQ(rank_note(observability_of(model), false),
            "the sensors cannot tell health parameters {h1, h3} apart: 3 combinations of health are seen, of 4");
  EXPECT_EQ(design_tuner(model, {}).full.V.rows(), 3);
}

TEST(ObservabilityTest, RefusesSensorsThatSeeNothingAtAll) {
  linear_model::LinearModel model = test::made_up_model(3, 4);
  model.C.setZero();
  model.M.setZero();
  try {
    design_tuner(model, {});
    FAIL() << "sensors without any signal were accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("no sensor sees anything of health in the steady state"));
  }
}

TEST(ObservabilityTest, PairHasTheRankOfItsMatrix) {
  // A double integrator seen at its position is observable, seen at its rate it is not.
  const Eigen::Matrix2d A = (Eigen::Matrix2d() << 1.0, 1.0, 0.0, 1.0).finished();
  const Eigen::VectorXd sigma = Eigen::VectorXd::Ones(1);
  EXPECT_GT(pair_singular_values(A, Eigen::RowVector2d(1.0, 0.0), sigma)(1), 0.1);
  EXPECT_LT(pair_singular_values(A, Eigen::RowVector2d(0.0, 1.0), sigma)(1), 1e-12);
}

}  // namespace
}  // namespace ehm::tuner_design
