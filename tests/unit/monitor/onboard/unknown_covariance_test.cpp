// SPDX-License-Identifier: Apache-2.0
// The covariance against the dense formulas of the Kalman filter, and what a consider update leaves alone.

#include "monitor/onboard/unknown_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "engine_sim/engines/jt9d_engine.h"
#include "tests/unit/monitor/onboard/on_board_point.h"

namespace ehm::onboard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Symmetric, with correlations, by taking in two odd readings.
class Covariance : public ::testing::Test {
 protected:
  Covariance() {
    UnknownVector sigma = UnknownVector::LinSpaced(layout_.count(), 0.5, 2.0);
    const Eigen::Index n = layout_.health_count + layout_.cause_count;
    p_.start(UnknownMatrix::Zero(n, n));
    p_.open(0, sigma.cwiseAbs2());
    p_.update(UnknownVector::LinSpaced(layout_.count(), -1.0, 1.5), 0.3, true);
    p_.update(UnknownVector::Constant(layout_.count(), 0.7), 0.2, true);
  }
  test::OnBoardPoint point_ = test::on_board_cruise();
  UnknownLayout layout_{*point_.model};
  UnknownCovariance p_{layout_};
};

TEST_F(Covariance, PredictIsPhiPPhiPlusQ) {
  const StepSize step{.dt_s = 0.05, .speed_variance = 1e-4, .health_variance = 1e-6, .memory = 0.9};
  const Eigen::Index n = layout_.count(), m = layout_.sensor_count;
  MatrixXd phi = MatrixXd::Identity(n, n), q = MatrixXd::Zero(n, n);
  const Eigen::Matrix2d f = point_.tangent.speed_rates();
  const MatrixXd rates = point_.tangent.rates();
  phi.topRows(2) += step.dt_s * rates + 0.5 * step.dt_s * step.dt_s * f * rates;
  phi.bottomRightCorner(m, m) *= step.memory;
  q.diagonal().head(2).setConstant(step.speed_variance);
  q.diagonal().segment(2, layout_.health_count).setConstant(step.health_variance);
  q.diagonal().tail(m) = (1.0 - step.memory * step.memory) * point_.tangent.path_variance();
  const MatrixXd expected = phi * MatrixXd(p_.matrix()) * phi.transpose() + q;
  p_.predict(point_.tangent, step);
  EXPECT_LT((p_.matrix() - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
  EXPECT_EQ(MatrixXd(p_.matrix()), MatrixXd(p_.matrix().transpose()));
}

TEST_F(Covariance, UpdateIsJosephsFormAndItsGain) {
  const MatrixXd before = p_.matrix();
  const VectorXd row = VectorXd::LinSpaced(layout_.count(), 2.0, -1.0);
  const double r = 0.4, s = row.dot(before * row) + r;
  const VectorXd gain = before * row / s;
  const MatrixXd i_kc = MatrixXd::Identity(row.size(), row.size()) - gain * row.transpose();
  const MatrixXd expected = i_kc * before * i_kc.transpose() + r * gain * gain.transpose();
  EXPECT_LT((VectorXd(p_.update(row, r, true)) - gain).norm(), 1e-13 * gain.norm());
  EXPECT_LT((p_.matrix() - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(Covariance, AConsiderUpdateMovesTheSpeedsAloneAndStaysACovariance) {
  const MatrixXd before = p_.matrix();
  const VectorXd row = VectorXd::LinSpaced(layout_.count(), 2.0, -1.0);
  const double r = 0.4;
  const VectorXd gain = p_.update(row, r, false);
  EXPECT_TRUE(gain.tail(gain.size() - 2).isZero(0.0));
  EXPECT_GT(gain.head(2).norm(), 0.0);
  const MatrixXd i_kc = MatrixXd::Identity(row.size(), row.size()) - gain * row.transpose();
  const MatrixXd expected = i_kc * before * i_kc.transpose() + r * gain * gain.transpose();
  EXPECT_LT((p_.matrix() - expected).cwiseAbs().maxCoeff(), 1e-12);
  const Eigen::Index others = gain.size() - 2;
  EXPECT_EQ(MatrixXd(p_.matrix().bottomRightCorner(others, others)), before.bottomRightCorner(others, others));
}

TEST_F(Covariance, StaysPositiveOverAHundredThousandSmallNoises) {
  const StepSize step{.dt_s = 0.015, .speed_variance = 2.5e-7, .health_variance = 1e-8, .memory = 1.0};
  for (int k = 0; k < 100'000 / 7; ++k) {
    p_.predict(point_.tangent, step);
    for (Eigen::Index i = 0; i < layout_.sensor_count; ++i)
      p_.update(point_.tangent.readings().row(i).transpose(), 0.25, true);
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(p_.matrix()), Eigen::EigenvaluesOnly);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-12 * eigen.eigenvalues().maxCoeff());
}

}  // namespace
}  // namespace ehm::onboard
