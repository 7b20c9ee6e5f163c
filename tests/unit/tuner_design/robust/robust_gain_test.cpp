// SPDX-License-Identifier: Apache-2.0
// The robust gain is the Kalman gain for one factor on the sensors' noise: its gradient vanishes there, nothing near is
// better, and a wrong noise costs it less than the standard gain.

#include "tuner_design/robust/robust_gain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::tuner_design {
namespace {

using test::Random;

/// A seeded stable model of n states, m sensors.
RobustProblem seeded(Eigen::Index n, Eigen::Index m, std::uint64_t seed) {
  Random random(seed);
  RobustProblem p{random.normal_matrix(n, n), random.normal_matrix(m, n), {}, Eigen::MatrixXd::Identity(n, n), {}};
  p.A *= 0.97 / estimation::spectral_radius(p.A);
  const Eigen::MatrixXd root = random.normal_matrix(n, n);
  p.Q = 0.01 * root * root.transpose();
  p.R.resize(m);
  for (double& r : p.R) r = random.uniform(0.5, 2.0);
  return p;
}

constexpr RobustWeights uncertain{1.0, 1.0, 0.3, 1.0};

TEST(RobustGain, ItsGradientVanishes) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const RobustProblem p = seeded(24, 12, seed);
    const RobustGain gain = robust_gain(p, uncertain);
    EXPECT_LT(gain.relative_gradient, 1e-10) << seed;
    EXPECT_LE(gain.riccati_equations, 20) << seed;
    EXPECT_NEAR(gain.objective, robust_objective(p, uncertain, gain.K), 1e-9 * gain.objective);
    // the equation of the root
    const double c1 = 1.0 + 2.0 * 0.09 * gain.process, c2 = 1.0 + 2.0 * gain.sensor;
    EXPECT_NEAR(gain.mu(0), c2 / c1, 1e-9 * gain.mu(0));
  }
}

TEST(RobustGain, NothingNearIsBetter) {
  const RobustProblem p = seeded(6, 3, 4);
  const RobustGain gain = robust_gain(p, uncertain);
  Random random(5);
  for (int k = 0; k < 50; ++k) {
    const Eigen::MatrixXd other = gain.K + 1e-3 * gain.K.norm() * random.normal_matrix(6, 3);
    EXPECT_GT(robust_objective(p, uncertain, other), gain.objective);
  }
}

TEST(RobustGain, TheGradientIsThatOfDifferences) {
  const RobustProblem p = seeded(5, 3, 6);
  const Eigen::MatrixXd K = robust_gain(p, uncertain).K * 0.8;
  Eigen::MatrixXd gradient;
  robust_objective(p, uncertain, K, &gradient);
  for (Eigen::Index i = 0; i < K.size(); ++i) {
    constexpr double step = 1e-5;
    Eigen::MatrixXd up = K, down = K;
    up(i) += step;
    down(i) -= step;
    const double slope = (robust_objective(p, uncertain, up) - robust_objective(p, uncertain, down)) / (2.0 * step);
    EXPECT_NEAR(gradient(i), slope, 1e-5 * gradient.norm()) << i;
  }
}

TEST(RobustGain, WithoutUncertaintyIsTheKalmanGain) {
  const RobustGain gain = robust_gain(seeded(6, 3, 7), {1.0, 1.0, 0.0, 0.0});
  EXPECT_EQ(gain.mu(0), 1.0);
  EXPECT_LT(gain.relative_gradient, 1e-10);
}

TEST(RobustGain, SensorNoiseThatGrowsCostsItLess) {
  const RobustProblem p = seeded(8, 4, 8);
  const Eigen::MatrixXd standard = robust_gain(p, {1.0, 1.0, 0.0, 0.0}).K,
                        robust = robust_gain(p, {1.0, 1.0, 0.0, 1.0}).K;
  RobustProblem nine = p;
  nine.R *= 9.0;
  constexpr RobustWeights error{1.0, 0.0, 0.0, 0.0};
  EXPECT_LT(robust_objective(nine, error, robust), robust_objective(nine, error, standard));
  EXPECT_GT(robust_objective(p, error, robust), robust_objective(p, error, standard));
}

TEST(RobustGain, BySensorOnlyTheUncertainOneIsTrustedLess) {
  const RobustProblem p = seeded(6, 3, 9);
  const Eigen::Vector3d s(0.0, 2.0, 0.0);
  const RobustGain gain = robust_gain_by_sensor(p, {1.0, 1.0, 0.0, 0.0}, s);
  EXPECT_NEAR(gain.mu(0), 1.0, 1e-12);
  EXPECT_GT(gain.mu(1), 1.01);
  EXPECT_NEAR(gain.mu(2), 1.0, 1e-12);
  EXPECT_LT(gain.relative_gradient, 1e-10);
  // alike, it is the gain of one uncertainty for all only where each V2_j is the whole V2: of one sensor
  const RobustProblem one = seeded(5, 1, 12);
  const RobustGain by_sensor = robust_gain_by_sensor(one, {1.0, 1.0, 0.0, 0.0}, Eigen::VectorXd::Ones(1)),
                   common = robust_gain(one, {1.0, 1.0, 0.0, 1.0});
  EXPECT_NEAR(by_sensor.mu(0), common.mu(0), 1e-9);
  EXPECT_NEAR(by_sensor.objective, common.objective, 1e-9 * common.objective);
}

TEST(RobustGain, TheTradeFallsInOnePartAndRisesInTheOther) {
  const std::vector<RobustTrade> curve = robust_trade(seeded(6, 3, 10), 0.01, 100.0, 20);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    EXPECT_GT(curve[i].process, curve[i - 1].process);
    EXPECT_LT(curve[i].sensor, curve[i - 1].sensor);
  }
}

TEST(RobustGain, WrongInputIsNamed) {
  RobustProblem p = seeded(4, 2, 11);
  EXPECT_THROW(robust_gain(p, {0.0, 1.0, 0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(robust_gain(p, {1.0, 1.0, -1.0, 1.0}), std::invalid_argument);
  p.R(0) = 0.0;
  EXPECT_THROW(robust_gain(p, uncertain), std::invalid_argument);
  p.R.resize(3);
  EXPECT_THROW(robust_gain(p, uncertain), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::tuner_design
