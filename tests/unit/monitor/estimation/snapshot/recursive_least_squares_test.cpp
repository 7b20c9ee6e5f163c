// SPDX-License-Identifier: Apache-2.0
// Recursive least squares against the batch solution, whose matrices are written out; its error against that of the
// weights which it gives each reading; and that it cannot wind up.

#include "monitor/estimation/snapshot/recursive_least_squares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "tests/unit/monitor/estimation/snapshot/snapshot_models.h"

namespace ehm::estimation {
namespace {

using namespace test_snapshot;

constexpr int sensors = 4, health = 6, samples = 12;

std::shared_ptr<const SnapshotModel> some_model(std::uint64_t seed = 31) {
  return std::make_shared<const SnapshotModel>(snapshot_model(random_engine(sensors, health, seed)));
}

/// Every third sample lacks sensor 1, every fifth all but sensor 2.
SensorMask present_at(int k) {
  if (k % 5 == 4) return SensorMask(0b0100);
  return k % 3 == 2 ? SensorMask(0b1101) : SensorMask(0b1111);
}

/// After `readings`, of which those that are absent are NaN.
RecursiveLeastSquares flown(const std::shared_ptr<const SnapshotModel>& model, double kept,
                            const std::vector<SensorVector>& readings) {
  RecursiveLeastSquares estimate(model, kept);
  for (std::size_t k = 0; k < readings.size(); ++k) {
    if (k > 0) estimate.pass(1);
    const SensorMask present = present_at(static_cast<int>(k));
    SensorVector e = readings[k];
    for (int i = 0; i < sensors; ++i)
      if (!present[as_size(i)]) e(i) = std::numeric_limits<double>::quiet_NaN();
    estimate.update(e, present);
  }
  return estimate;
}

std::vector<SensorVector> random_readings(std::uint64_t seed) {
  test::Random random(seed);
  std::vector<SensorVector> readings;
  for (int k = 0; k < samples; ++k) readings.emplace_back(5.0 * random.normal_vector(sensors));
  return readings;
}

/// (I + sum of lambda^(k-i) Hn^T Hn)^-1 (sum of lambda^(k-i) Hn^T e): all readings at once.
struct Batch {
  Batch(const SnapshotModel& model, double kept, const std::vector<SensorVector>& readings)
      : information(Eigen::MatrixXd::Identity(health, health)) {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(health);
    for (std::size_t k = 0; k < readings.size(); ++k) {
      const double weight = std::pow(kept, static_cast<double>(readings.size() - 1 - k));
      const Eigen::MatrixXd Hn = rows(model.health_signal, present_at(static_cast<int>(k)));
      information += weight * Hn.transpose() * Hn;
      right += weight * Hn.transpose() * rows(readings[k], present_at(static_cast<int>(k)));
    }
    covariance = information.inverse();
    estimate = covariance * right;
  }
  Eigen::MatrixXd information, covariance;
  Eigen::VectorXd estimate;
};

TEST(RecursiveLeastSquares, IsTheBatchSolutionWithAndWithoutForgetting) {
  for (const double kept : {1.0, 0.999, 0.9, 0.5}) {
    SCOPED_TRACE(kept);
    const auto model = some_model();
    const auto readings = random_readings(32);
    const RecursiveLeastSquares estimate = flown(model, kept, readings);
    const Batch batch(*model, kept, readings);
    EXPECT_TRUE(estimate.health().isApprox(batch.estimate, 1e-9));
    EXPECT_TRUE(estimate.own_covariance().isApprox(batch.covariance, 1e-9));
  }
}

TEST(RecursiveLeastSquares, TheFirstSampleOfAnEngineInBalanceIsMapAndTheNextOnesAreMapOnTheirAverage) {
  const auto model =
      std::make_shared<const SnapshotModel>(snapshot_model(in_balance(random_engine(sensors, health, 33))));
  RecursiveLeastSquares estimate(model, 1.0);
  const SensorVector e = random_readings(34).front();
  estimate.update(e, first(sensors));
  EXPECT_TRUE(estimate.health().isApprox(HealthVector(map_gain(*model, first(sensors)) * e), 1e-9));
  constexpr int many = 50;
  for (int k = 1; k < many; ++k) {
    estimate.pass(1);
    estimate.update(e, first(sensors));
  }
  const Eigen::MatrixXd Hn = model->health_signal;
  const Eigen::MatrixXd averaged = Eigen::MatrixXd::Identity(sensors, sensors) / many;
  const Eigen::MatrixXd map = Hn.transpose() * (Hn * Hn.transpose() + averaged).inverse();
  EXPECT_TRUE(estimate.health().isApprox(map * e, 1e-9));
  // without motion and Lambda it is right about itself
  EXPECT_TRUE(health_covariance(estimate.error(), 1.0).isApprox(estimate.own_covariance(), 1e-9));
}

/// The estimate is linear: its weight on each reading, found by readings of 1, gives its error without any recursion.
TEST(RecursiveLeastSquares, ItsErrorIsThatOfTheWeightsItGivesToEachReading) {
  const auto model = some_model(35);
  const linear_model::LinearModel engine = random_engine(sensors, health, 35);
  constexpr double kept = 0.8;
  const int all = samples * sensors;
  std::vector<SensorVector> none(samples, SensorVector::Zero(sensors));
  Eigen::MatrixXd weight(health, all), Hn(all, health), En(all, sensors + 2), Cn(all, 2);
  for (int k = 0; k < samples; ++k) {
    for (int i = 0; i < sensors; ++i) {
      auto readings = none;
      readings[as_size(k)](i) = 1.0;
      weight.col(k * sensors + i) = flown(model, kept, readings).health();
    }
    Hn.middleRows(k * sensors, sensors) = model->health_signal;
    En.middleRows(k * sensors, sensors) = model->offset_signal;
    Cn.middleRows(k * sensors, sensors) = model->state_signal;
  }
  // cov(dx_j, dx_k) = A^(j-k) cov(dx), j >= k
  Eigen::MatrixXd noise = Eigen::MatrixXd::Identity(all, all), last(2, all);
  for (int k = 0; k < samples; ++k) {
    Eigen::MatrixXd later = model->motion;
    for (int j = k; j < samples; ++j) {
      const Eigen::MatrixXd block =
          Eigen::MatrixXd(model->state_signal) * later * Eigen::MatrixXd(model->state_signal).transpose();
      noise.block(j * sensors, k * sensors, sensors, sensors) += block;
      if (j > k) noise.block(k * sensors, j * sensors, sensors, sensors) += block.transpose();
      if (j == samples - 1)
        last.middleCols(k * sensors, sensors) = later * Eigen::MatrixXd(model->state_signal).transpose();
      later = (engine.A * later).eval();
    }
  }
  const RecursiveLeastSquares estimate = flown(model, kept, none);
  const SnapshotError& error = estimate.error();
  EXPECT_TRUE(error.health_bias.isApprox(weight * Hn - Eigen::MatrixXd::Identity(health, health), 1e-9));
  EXPECT_TRUE(error.offset_bias.isApprox(weight * En, 1e-9));
  EXPECT_TRUE(error.motion_cross.isApprox(last * weight.transpose(), 1e-9));
  EXPECT_TRUE(error.noise.isApprox(weight * noise * weight.transpose(), 1e-9));
}

TEST(RecursiveLeastSquares, SeveralSamplesAtOnceAreOneAfterTheOther) {
  const auto model = some_model();
  RecursiveLeastSquares once = flown(model, 0.9, random_readings(36)), again = once;
  once.pass(3);
  for (int k = 0; k < 3; ++k) again.pass(1);
  EXPECT_TRUE(once.health().isApprox(again.health(), 1e-12));
  EXPECT_TRUE(once.error().health_bias.isApprox(again.error().health_bias, 1e-12));
  EXPECT_TRUE(once.error().offset_bias.isApprox(again.error().offset_bias, 1e-12));
  EXPECT_TRUE(once.error().motion_cross.isApprox(again.error().motion_cross, 1e-12));
  EXPECT_TRUE(once.error().noise.isApprox(again.error().noise, 1e-12));
}

// P/lambda would have grown by e^1000 where nothing is seen.
TEST(RecursiveLeastSquares, DoesNotWindUpWhereNothingIsSeenAndReturnsToThePriorInSilence) {
  const auto model = some_model();
  RecursiveLeastSquares estimate(model, 0.99);
  const auto readings = random_readings(37);
  for (int k = 0; k < 100'000; ++k) {
    estimate.pass(1);
    estimate.update(readings[as_size(k % samples)], present_at(k));
  }
  const Eigen::MatrixXd P = estimate.own_covariance(), S = estimate.error().noise;
  EXPECT_EQ((P - P.transpose()).norm(), 0.0);
  EXPECT_EQ((S - S.transpose()).norm(), 0.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_p(P), of_s(S);
  EXPECT_GT(of_p.eigenvalues().minCoeff(), 0.0);
  EXPECT_NEAR(of_p.eigenvalues().maxCoeff(), 1.0, 1e-9);  // two directions that no sensor sees: the prior
  EXPECT_GT(of_s.eigenvalues().minCoeff(), -1e-12);
  estimate.pass(100'000);
  EXPECT_TRUE(estimate.own_covariance().isIdentity(1e-9));
  EXPECT_LT(estimate.health().norm(), 1e-9);
  EXPECT_LT(estimate.error().noise.norm(), 1e-9);
}

TEST(RecursiveLeastSquares, RefusesWhatIsNoForgettingFactorAndNoState) {
  const auto model = some_model();
  for (const double kept : {0.0, -0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(RecursiveLeastSquares(model, kept), std::invalid_argument) << kept;
  RecursiveLeastSquares estimate = flown(model, 0.9, random_readings(38));
  const HealthVector before = estimate.health();
  SnapshotError error = estimate.error();
  EXPECT_TRUE(estimate.restore(before, error));
  error.health_bias(0, 1) += 0.01;
  EXPECT_FALSE(estimate.restore(2.0 * before, error)) << "not symmetric";
  error = nothing_seen(*model);
  error.health_bias(0, 0) = 0.1;
  EXPECT_FALSE(estimate.restore(2.0 * before, error)) << "a negative variance";
  error.health_bias(0, 0) = -1.1;
  EXPECT_FALSE(estimate.restore(2.0 * before, error)) << "more than the prior";
  EXPECT_EQ(estimate.health(), before);
}

}  // namespace
}  // namespace ehm::estimation
