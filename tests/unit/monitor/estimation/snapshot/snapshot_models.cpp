// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/monitor/estimation/snapshot/snapshot_models.h"

#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/discretise.h"
#include "engine_sim/linear_model/scaling.h"
#include "engine_sim/linear_model/stationary_covariance.h"

namespace ehm::estimation::test_snapshot {

linear_model::LinearModel random_engine(int sensors, int health, std::uint64_t seed) {
  test::Random random(seed);
  const linear_model::LinearModel made_up = test::made_up_model(sensors, health);
  linear_model::LinearModel model = linear_model::scaled(made_up, linear_model::scaling_of(made_up));
  model.L = 0.05 * random.normal_matrix(2, health);
  model.C = random.normal_matrix(sensors, 2);
  model.M = random.normal_matrix(sensors, health);
  model.N = random.normal_matrix(2, health);
  model.health_sigma = random.normal_matrix(health, 1).array().abs() + 0.1;
  model.sensor_noise_sigma = random.normal_matrix(sensors, 1).array().abs() + 0.1;
  const Eigen::MatrixXd motion = 0.1 * random.normal_matrix(2, 2);
  model.process_noise = motion * motion.transpose();
  const Eigen::MatrixXd missed = 0.3 * random.normal_matrix(sensors + 2, sensors + 2);
  model.linearisation_error = missed * missed.transpose();
  return model;
}

linear_model::LinearModel in_balance(linear_model::LinearModel model) {
  model.process_noise.setZero();
  model.linearisation_error.resize(0, 0);
  return model;
}

linear_model::LinearModel jt9d_in_balance() {
  const linear_model::LinearModel model = test::jt9d_cruise();
  return in_balance(linear_model::scaled(linear_model::discretise(model), linear_model::scaling_of(model)));
}

Textbook::Textbook(const linear_model::LinearModel& model)
    : Ph(model.health_sigma.cwiseAbs2().asDiagonal()), R(model.sensor_noise_sigma.cwiseAbs2().asDiagonal()) {
  const Eigen::Index n = model.A.rows();
  const Eigen::MatrixXd X = (Eigen::MatrixXd::Identity(n, n) - model.A).inverse() * model.L;
  H = model.C * X + model.M;
  Hz = model.F * X + model.N;
  motion = linear_model::stationary_covariance(model.A, model.process_noise);
}

Eigen::MatrixXd rows(const Eigen::MatrixXd& all, SensorMask sensors) {
  Eigen::MatrixXd some(as_index(sensors.count()), all.cols());
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    if (sensors[as_size(i)]) some.row(next++) = all.row(i);
  return some;
}

}  // namespace ehm::estimation::test_snapshot
