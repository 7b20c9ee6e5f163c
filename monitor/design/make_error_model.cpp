// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/make_error_model.h"

#include <cmath>

#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/design/closed_loop.h"
#include "monitor/design/fleet_unknowns.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::design {

namespace {

/// What the sensors' noise and the engine's own motion add at each sample, and what the latter has brought before.
void add_noise(estimation::ErrorModel& error, const linear_model::LinearModel& model, const SubsetDesign& subset) {
  const Eigen::Index n = model.C.cols(), size = subset.A.rows();
  const Eigen::MatrixXd& Q = model.process_noise;
  const Eigen::MatrixXd R = model.sensor_noise_sigma.cwiseAbs2().asDiagonal();
  error.noise = noise_of_a_sample(subset, model);
  error.start.setZero(size, size);
  error.start.topLeftCorner(n, n) = linear_model::stationary_covariance(subset.A.topLeftCorner(n, n), Q);
  error.innovation_noise = (model.C * Q * model.C.transpose()).diagonal() + R.diagonal();
}

}  // namespace

estimation::ErrorModel make_error_model(const Design& design, const SubsetDesign& subset) {
  const linear_model::LinearModel model = linear_model::scaled(design.model, design.scaling);
  const Eigen::Index n = model.A.rows(), t = subset.V.rows(), p = model.L.cols(), r = model.F.rows();

  estimation::ErrorModel error;
  error.closed_loop = closed_loop(subset);
  add_noise(error, model, subset);
  error.health_output.setZero(p, n + t);
  error.health_output.rightCols(t) = subset.health_readout;
  error.auxiliary_output.setZero(r, n + t);
  error.auxiliary_output.leftCols(n) = model.F;
  error.auxiliary_output.rightCols(t) = subset.auxiliary_readout;
  error.prediction = subset.C * subset.A;
  const FleetUnknowns unknowns = fleet_unknowns(model, estimation::steady_gain(model));
  error.health_truth = unknowns.health;
  error.sensor_truth = unknowns.sensors;
  error.auxiliary_truth = unknowns.auxiliary;
  error.drive = subset.K * unknowns.sensors;
  error.health_scale = design.scaling.health;
  error.auxiliary_scale = design.scaling.auxiliary;
  error.sensor_scale = design.scaling.sensor;
  error.settling_samples = subset.settling_samples(design.model.sample_time_s);
  return error;
}

}  // namespace ehm::design
