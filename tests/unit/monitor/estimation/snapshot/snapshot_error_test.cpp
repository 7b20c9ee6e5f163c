// SPDX-License-Identifier: Apache-2.0
// The error of any gain against the covariances of the textbook, part by part, and as a state.

#include "monitor/estimation/snapshot/snapshot_error.h"

#include <gtest/gtest.h>

#include "engine_sim/linear_model/stationary_covariance.h"
#include "tests/unit/monitor/estimation/snapshot/snapshot_models.h"

namespace ehm::estimation {
namespace {

using namespace test_snapshot;

struct Case {
  linear_model::LinearModel engine = random_engine(5, 7, 21);
  SnapshotModel model = snapshot_model(engine);
  Textbook book{engine};
  Eigen::MatrixXd lambda_y = engine.linearisation_error.topLeftCorner(5, 5),
                  lambda_zy = engine.linearisation_error.bottomLeftCorner(2, 5),
                  lambda_z = engine.linearisation_error.bottomRightCorner(2, 2);
  /// Some gain, and the same of scaled units.
  SnapshotGain gain = [] {
    test::Random random(22);
    return SnapshotGain(0.2 * random.normal_matrix(7, 5));
  }();
  Eigen::MatrixXd E =
      model.health_sigma.asDiagonal() * Eigen::MatrixXd(gain) * model.noise_sigma.cwiseInverse().asDiagonal();
  SnapshotError error = error_of(model, gain);
};

TEST(SnapshotError, OfHealthIsBiasAndNoiseOfTheGain) {
  const Case c;
  const Eigen::MatrixXd bias = c.E * c.book.H - Eigen::MatrixXd::Identity(7, 7);
  const Eigen::MatrixXd C = c.engine.C;
  const Eigen::MatrixXd prior = bias * c.book.Ph * bias.transpose(), nonlinear = c.E * c.lambda_y * c.E.transpose(),
                        noise = c.E * (c.book.R + C * c.book.motion * C.transpose()) * c.E.transpose();
  const auto parts = health_variance(c.error);
  const HealthVector variance = c.model.health_sigma.cwiseAbs2();
  EXPECT_TRUE(parts.prior.cwiseProduct(variance).isApprox(prior.diagonal(), 1e-9));
  EXPECT_TRUE(parts.nonlinear.cwiseProduct(variance).isApprox(nonlinear.diagonal(), 1e-9));
  EXPECT_TRUE(parts.noise.cwiseProduct(variance).isApprox(noise.diagonal(), 1e-9));
  const auto scale = c.model.health_sigma.asDiagonal();
  const Eigen::MatrixXd widened = scale * Eigen::MatrixXd(health_covariance(c.error, 3.0)) * scale;
  EXPECT_TRUE(widened.isApprox(3.0 * prior + 9.0 * nonlinear + noise, 1e-9));
}

TEST(SnapshotError, OfOutputsHasTheirOwnMotionAndNonlinearityInIt) {
  // zhat - z = Hz (E y - h) - F dx - rz,  y = H h + ry + C dx + v
  const Case c;
  const Eigen::MatrixXd K = c.book.Hz * c.E, bias = K * c.book.H - c.book.Hz;
  const Eigen::MatrixXd dx = K * c.engine.C - c.engine.F;
  const auto parts = auxiliary_variance(c.model, c.error);
  EXPECT_TRUE(parts.prior.isApprox((bias * c.book.Ph * bias.transpose()).diagonal(), 1e-9));
  EXPECT_TRUE(parts.nonlinear.isApprox(
      (K * c.lambda_y * K.transpose() - K * c.lambda_zy.transpose() - c.lambda_zy * K.transpose() + c.lambda_z)
          .diagonal(),
      1e-9));
  EXPECT_TRUE(
      parts.noise.isApprox((K * c.book.R * K.transpose() + dx * c.book.motion * dx.transpose()).diagonal(), 1e-9));
}

TEST(SnapshotError, OfALaterSampleHasWhatIsLeftOfTheMotion) {
  // e[k+2] - H E e[k]: dx[k+2] = A^2 dx[k] + what is new
  Case c;
  move_on(c.model, c.error);
  move_on(c.model, c.error);
  const Eigen::MatrixXd C = c.engine.C, K = c.book.H * c.E, bias = c.book.H - K * c.book.H;
  const Eigen::MatrixXd own = K - Eigen::MatrixXd::Identity(5, 5);
  const Eigen::MatrixXd later = c.engine.A * c.engine.A * c.book.motion;
  const Eigen::MatrixXd cross = C * later * C.transpose() * K.transpose();
  const Eigen::MatrixXd moved = C * c.book.motion * C.transpose();
  const auto parts = innovation_variance(c.model, c.error);
  const SensorVector variance = c.model.noise_sigma.cwiseAbs2();
  EXPECT_TRUE(parts.prior.cwiseProduct(variance).isApprox((bias * c.book.Ph * bias.transpose()).diagonal(), 1e-9));
  EXPECT_TRUE(parts.nonlinear.cwiseProduct(variance).isApprox((own * c.lambda_y * own.transpose()).diagonal(), 1e-9));
  EXPECT_TRUE(parts.noise.cwiseProduct(variance).isApprox(
      (moved - cross - cross.transpose() + K * (moved + c.book.R) * K.transpose() + c.book.R).diagonal(), 1e-9));
}

TEST(SnapshotError, NothingSeenIsThePrior) {
  const Case c;
  const SnapshotError error = nothing_seen(c.model);
  EXPECT_TRUE(health_covariance(error, 1.0).isIdentity(0.0));
  const Eigen::MatrixXd F = c.engine.F;
  const auto parts = auxiliary_variance(c.model, error);
  EXPECT_TRUE(parts.prior.isApprox((c.book.Hz * c.book.Ph * c.book.Hz.transpose()).diagonal(), 1e-9));
  EXPECT_TRUE(parts.nonlinear.isApprox(c.lambda_z.diagonal(), 1e-9));
  EXPECT_TRUE(parts.noise.isApprox((F * c.book.motion * F.transpose()).diagonal(), 1e-9));
}

TEST(SnapshotError, GoesThroughAStateToTheBitAndNoOtherShapeDoes) {
  const Case c;
  ErrorState state;
  save(c.model, c.error, state);
  SnapshotError back = nothing_seen(c.model);
  ASSERT_TRUE(restore(c.model, state, back));
  EXPECT_EQ(back.health_bias, c.error.health_bias);
  EXPECT_EQ(back.offset_bias, c.error.offset_bias);
  EXPECT_EQ(back.motion_cross, c.error.motion_cross);
  EXPECT_EQ(back.noise, c.error.noise);
  const SnapshotModel other = snapshot_model(in_balance(c.engine));  // has no Lambda
  EXPECT_FALSE(restore(other, state, back));
  EXPECT_EQ(back.noise, c.error.noise);
}

}  // namespace
}  // namespace ehm::estimation
