// SPDX-License-Identifier: Apache-2.0
#include "monitor/listen/expectation.h"

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/scaling.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::monitor {

Expectation expect_sensors(const linear_model::LinearModel& model, const Eigen::VectorXd& actuators) {
  const auto m = as_index(model.sensors.size());
  Eigen::VectorXd trim(m), size(m), du(actuators.size());
  for (Eigen::Index i = 0; i < m; ++i) {
    const linear_model::Channel& sensor = model.sensors[as_size(i)];
    trim(i) = sensor.trim, size(i) = linear_model::size_of_trim(sensor);
  }
  for (Eigen::Index i = 0; i < du.size(); ++i) du(i) = actuators(i) - model.controls[as_size(i)].trim;

  // The gain of the actuators is that of a model whose "health" they are.
  linear_model::LinearModel acted = model;
  acted.L = model.B;
  acted.M = model.D;
  acted.N = model.G;
  const Eigen::MatrixXd H = estimation::steady_gain(model).H;
  Eigen::VectorXd value = trim;
  if (du.size() > 0) value += estimation::steady_gain(acted).H * du;

  Eigen::VectorXd variance = (H * model.health_sigma.asDiagonal()).rowwise().squaredNorm() +
                             model.sensor_noise_sigma.cwiseAbs2() + (0.01 * size).cwiseAbs2();
  if (model.linearisation_error.size() > 0) variance += model.linearisation_error.diagonal().head(m);
  return {value, variance.cwiseSqrt()};
}

}  // namespace ehm::monitor
