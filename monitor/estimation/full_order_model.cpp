// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/full_order_model.h"

#include <stdexcept>
#include <string>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::estimation {
namespace {

void require_capacity(const char* list, std::size_t size, int capacity) {
  if (size <= as_size(capacity)) return;
  throw std::invalid_argument(std::string("full-order filter: ") + std::to_string(size) + " " + list +
                              "; allowed: at most " + std::to_string(capacity));
}

}  // namespace

FullOrderModel full_order_model(const linear_model::LinearModel& model) {
  if (!model.discrete)
    throw std::invalid_argument("full-order filter: the model is continuous; linear_model::discretise it first");
  require_capacity("states", model.states.size(), max_states);
  require_capacity("controls", model.controls.size(), max_actuators);
  require_capacity("health parameters", model.health.size(), max_health);
  require_capacity("sensors", model.sensors.size(), max_sensors);
  require_capacity("auxiliary outputs", model.auxiliary.size(), max_auxiliary);
  const Eigen::Index n = model.A.rows(), p = model.L.cols();
  FullOrderModel full;
  full.A = model.A;
  full.B = model.B;
  full.L = model.L;
  full.sensor_output.resize(model.C.rows(), n + p);
  full.sensor_output << model.C, model.M;
  full.D = model.D;
  full.auxiliary_output.resize(model.F.rows(), n + p);
  full.auxiliary_output << model.F, model.N;
  full.G = model.G;
  full.process_noise = model.process_noise;
  full.sensor_noise_variance = model.sensor_noise_sigma.cwiseAbs2();
  Eigen::MatrixXd settled(n + p, p);  // [X; I] Ph^1/2
  settled << steady_gain(model).X, Eigen::MatrixXd::Identity(p, p);
  settled = (settled * model.health_sigma.asDiagonal()).eval();
  full.prior = settled * settled.transpose();
  full.prior.topLeftCorner(n, n) += linear_model::stationary_covariance(model.A, model.process_noise);
  const Eigen::Index m = model.C.rows(), r = model.F.rows();
  full.sensor_offset.resize(m, model.linearisation_error.cols());
  full.auxiliary_offset.resize(r, model.linearisation_error.cols());
  if (model.linearisation_error.size() > 0) {
    const Eigen::MatrixXd offset = linear_model::covariance_root(model.linearisation_error);
    full.sensor_offset = offset.topRows(m);
    full.auxiliary_offset = offset.bottomRows(r);
  }
  return full;
}

}  // namespace ehm::estimation
