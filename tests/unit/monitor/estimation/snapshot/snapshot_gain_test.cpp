// SPDX-License-Identifier: Apache-2.0
// Gains and errors of one snapshot: against the textbook's formulas, against numpy on the JT9D, and map against wls on
// random engines.

#include "monitor/estimation/snapshot/snapshot_gain.h"

#include <gtest/gtest.h>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/estimation/snapshot/snapshot_error.h"
#include "tests/unit/monitor/estimation/snapshot/snapshot_models.h"
#include "tuner_design/theory/map_estimator.h"

namespace ehm::estimation {
namespace {

using namespace test_snapshot;
using linear_model::LinearModel;

/// E of scaled health and readings, of all sensors.
Eigen::MatrixXd scaled_gain(const SnapshotModel& model, const SnapshotGain& gain) {
  return model.health_sigma.asDiagonal() * Eigen::MatrixXd(gain) * model.noise_sigma.cwiseInverse().asDiagonal();
}

/// Variance of each parameter, percent^2.
Eigen::VectorXd total(const SnapshotModel& model, const SnapshotGain& gain) {
  const HealthCovariance covariance = health_covariance(error_of(model, gain), 1.0);
  return covariance.diagonal().cwiseProduct(model.health_sigma.cwiseAbs2());
}

TEST(SnapshotGain, MapOfAnEngineInBalanceIsSimonAndGargs) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const LinearModel engine = in_balance(random_engine(5, 8, seed));
    const SnapshotModel model = snapshot_model(engine);
    const Textbook book(engine);
    const SnapshotGain gain = map_gain(model, first(5));
    const Eigen::MatrixXd expected = tuner_design::full_map_gain(book.H, book.Ph, book.R);
    EXPECT_TRUE(scaled_gain(model, gain).isApprox(expected, 1e-9));
    EXPECT_TRUE(
        total(model, gain)
            .isApprox(tuner_design::snapshot_error_covariance(expected, book.H, book.Ph, book.R).diagonal(), 1e-9));
  }
}

// numpy (pinv, inv) on the fixture: H = C (-A^-1 L) + M in percent, Ph 2 %, noise of [SG] table 2;
// map 19.7171778195, that is [SG]'s 19.717 of theory.md, section 5; wls 38.9632826438; both without T24.
TEST(SnapshotGain, OnTheJt9dTheyErrAsNumpySays) {
  const SnapshotModel model = snapshot_model(jt9d_in_balance());
  const SensorMask all = first(7), without = SensorMask(all).reset(3);
  EXPECT_NEAR(total(model, map_gain(model, all)).sum() / 19.717177820, 1.0, 1e-7);
  EXPECT_NEAR(total(model, least_squares_gain(model, all)).sum() / 38.963282644, 1.0, 1e-7);
  Eigen::VectorXd map(10), wls(10);
  map << 2.73323193, 0.79629805, 2.40482155, 2.26987868, 1.78317361, 1.78519811, 2.3766608, 0.63003409, 2.44044713,
      2.49743387;
  wls << 3.41974411, 0.92532512, 6.24351672, 3.85853743, 5.71123929, 7.98018953, 3.47459968, 1.48201614, 2.68430666,
      3.18380798;
  EXPECT_TRUE(total(model, map_gain(model, all)).isApprox(map, 1e-7));
  EXPECT_TRUE(total(model, least_squares_gain(model, all)).isApprox(wls, 1e-7));
  // map can only lose by a sensor less; wls takes every reading at its word, and gains by one that says little
  EXPECT_NEAR(total(model, map_gain(model, without)).sum() / 20.578891636, 1.0, 1e-7);
  EXPECT_NEAR(total(model, least_squares_gain(model, without)).sum() / 25.833308951, 1.0, 1e-7);
}

TEST(SnapshotGain, MapIsTheBestLinearEstimateOfAMovingNonlinearEngine) {
  const LinearModel engine = random_engine(4, 6, 3);
  const SnapshotModel model = snapshot_model(engine);
  const Textbook book(engine);
  const Eigen::MatrixXd readings = book.H * book.Ph * book.H.transpose() + book.R +
                                   engine.C * book.motion * engine.C.transpose() +
                                   engine.linearisation_error.topLeftCorner(4, 4);
  const Eigen::MatrixXd expected = book.Ph * book.H.transpose() * readings.inverse();
  EXPECT_TRUE(scaled_gain(model, map_gain(model, first(4))).isApprox(expected, 1e-9));
  const Eigen::MatrixXd posterior = book.Ph - expected * book.H * book.Ph;
  EXPECT_TRUE(total(model, map_gain(model, first(4))).isApprox(posterior.diagonal(), 1e-9));
}

TEST(SnapshotGain, LeastSquaresOfMoreSensorsThanParametersIsTheWeightedOne) {
  const LinearModel engine = in_balance(random_engine(7, 3, 4));
  const SnapshotModel model = snapshot_model(engine);
  const Textbook book(engine);
  const Eigen::MatrixXd weighed = book.H.transpose() * book.R.inverse();
  const Eigen::MatrixXd expected = (weighed * book.H).inverse() * weighed;
  const SnapshotGain gain = least_squares_gain(model, first(7));
  EXPECT_TRUE(scaled_gain(model, gain).isApprox(expected, 1e-9));
  EXPECT_TRUE(total(model, gain).isApprox((weighed * book.H).inverse().diagonal(), 1e-9));
}

TEST(SnapshotGain, LeastSquaresOfFewerSensorsExplainsThemAllWithTheLeastHealth) {
  const LinearModel engine = in_balance(random_engine(4, 9, 5));
  const SnapshotModel model = snapshot_model(engine);
  const Textbook book(engine);
  const Eigen::MatrixXd E = scaled_gain(model, least_squares_gain(model, first(4)));
  EXPECT_TRUE((book.H * E).isApprox(Eigen::MatrixXd::Identity(4, 4), 1e-9));
  const Eigen::MatrixXd expected = book.Ph * book.H.transpose() * (book.H * book.Ph * book.H.transpose()).inverse();
  EXPECT_TRUE(E.isApprox(expected, 1e-9));
}

TEST(SnapshotGain, ASensorThatRepeatsAnotherIsAveragedAndOneThatSeesNothingIsLeftAlone) {
  LinearModel engine = in_balance(random_engine(4, 6, 6));
  engine.C.row(2) = engine.C.row(1);
  engine.M.row(2) = engine.M.row(1);
  engine.C.row(3).setZero();
  engine.M.row(3).setZero();
  engine.sensor_noise_sigma.setConstant(0.5);
  const SnapshotModel model = snapshot_model(engine);
  const SnapshotGain gain = least_squares_gain(model, first(4));
  EXPECT_TRUE(gain.col(1).isApprox(gain.col(2), 1e-6));
  EXPECT_TRUE((2.0 * gain.col(1)).isApprox(least_squares_gain(model, first(2)).col(1), 1e-6));
  EXPECT_LT(gain.col(3).norm(), 1e-9);
  EXPECT_TRUE(least_squares_gain(model, {}).isZero(0.0));
  EXPECT_TRUE(map_gain(model, {}).isZero(0.0));
}

TEST(SnapshotGain, WhatLeastSquaresLosesIsOneOverTheSquareOfTheSignal) {
  const SnapshotModel model = snapshot_model(jt9d_in_balance());
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Eigen::MatrixXd(model.health_signal), Eigen::ComputeFullV);
  const HealthCovariance map = health_covariance(error_of(model, map_gain(model, first(7))), 1.0);
  const HealthCovariance wls = health_covariance(error_of(model, least_squares_gain(model, first(7))), 1.0);
  Eigen::MatrixXd lost = Eigen::MatrixXd::Zero(10, 10);
  for (Eigen::Index i = 0; i < 7; ++i) {
    const double square = svd.singularValues()(i) * svd.singularValues()(i);
    lost += svd.matrixV().col(i) * svd.matrixV().col(i).transpose() / (square * (1.0 + square));
  }
  EXPECT_TRUE(Eigen::MatrixXd(wls - map).isApprox(lost, 1e-7));
  // what no sensor sees, neither knows
  const Eigen::MatrixXd unseen = svd.matrixV().rightCols(3);
  EXPECT_TRUE((unseen.transpose() * Eigen::MatrixXd(map) * unseen).isApprox(Eigen::MatrixXd::Identity(3, 3), 1e-9));
  EXPECT_TRUE((unseen.transpose() * Eigen::MatrixXd(wls) * unseen).isApprox(Eigen::MatrixXd::Identity(3, 3), 1e-9));
}

TEST(SnapshotGain, NoParameterIsKnownBetterByLeastSquaresWhateverTheEngine) {
  test::Random random(7);
  for (std::uint64_t seed = 100; seed < 160; ++seed) {
    const int sensors = 1 + static_cast<int>(seed % 9), health = 1 + static_cast<int>(seed / 3 % 12);
    const SnapshotModel model = snapshot_model(random_engine(sensors, health, seed));
    SensorMask some;
    for (int i = 0; i < sensors; ++i) some[as_size(i)] = random.uniform(0.0, 1.0) < 0.7;
    for (const SensorMask mask : {first(sensors), some}) {
      const HealthCovariance map = health_covariance(error_of(model, map_gain(model, mask)), 1.0);
      const HealthCovariance wls = health_covariance(error_of(model, least_squares_gain(model, mask)), 1.0);
      const Eigen::MatrixXd more = wls - map;
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(more);
      EXPECT_GE(spectrum.eigenvalues().minCoeff(), -1e-9 * wls.trace()) << seed;
      for (Eigen::Index i = 0; i < health; ++i) {
        EXPECT_GE(wls(i, i), (1.0 - 1e-9) * map(i, i)) << seed;
        EXPECT_LE(map(i, i), 1.0 + 1e-9) << "never worse than knowing nothing";
      }
    }
  }
}

}  // namespace
}  // namespace ehm::estimation
