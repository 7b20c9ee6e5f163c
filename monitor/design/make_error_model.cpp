// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/make_error_model.h"

#include <cmath>

#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/design/closed_loop.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::design {

namespace {

/// Gh = [Ph^1/2, 0], [Gy; Gz] = [[H; Hz] Ph^1/2, Lambda^1/2], and K Gy.
void add_unknowns(estimation::ErrorModel& error, const linear_model::LinearModel& model,
                  const estimation::SteadyGain& steady, const Eigen::MatrixXd& K) {
  const Eigen::Index p = model.L.cols(), m = model.C.rows(), r = model.F.rows();
  const Eigen::Index extra = model.linearisation_error.rows();
  const auto health = model.health_sigma.asDiagonal();
  error.health_truth.setZero(p, p + extra);
  error.health_truth.leftCols(p) = health.toDenseMatrix();
  error.sensor_truth.resize(m, p + extra);
  error.auxiliary_truth.resize(r, p + extra);
  error.sensor_truth.leftCols(p) = steady.H * health;
  error.auxiliary_truth.leftCols(p) = steady.Hz * health;
  if (extra > 0) {
    const Eigen::MatrixXd nonlinear = linear_model::covariance_root(model.linearisation_error);
    error.sensor_truth.rightCols(extra) = nonlinear.topRows(m);
    error.auxiliary_truth.rightCols(extra) = nonlinear.bottomRows(r);
  }
  error.drive = K * error.sensor_truth;
}

/// What the sensors' noise and the engine's own motion add at each sample, and what the latter has brought before.
void add_noise(estimation::ErrorModel& error, const linear_model::LinearModel& model, const SubsetDesign& subset) {
  const Eigen::Index n = model.C.cols(), size = subset.A.rows();
  const Eigen::MatrixXd& Q = model.process_noise;
  const Eigen::MatrixXd R = model.sensor_noise_sigma.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd entry = process_noise_entry(subset, n);
  error.noise = subset.K * R * subset.K.transpose() + entry * Q * entry.transpose();
  error.start.setZero(size, size);
  error.start.topLeftCorner(n, n) = linear_model::stationary_covariance(subset.A.topLeftCorner(n, n), Q);
  error.innovation_noise = (model.C * Q * model.C.transpose()).diagonal() + R.diagonal();
}

}  // namespace

estimation::ErrorModel make_error_model(const Design& design, const SubsetDesign& subset) {
  const linear_model::LinearModel model = linear_model::scaled(design.model, design.scaling);
  const estimation::SteadyGain steady = estimation::steady_gain(model);
  const Eigen::Index n = model.A.rows(), t = subset.V.rows(), p = model.L.cols(), r = model.F.rows();

  estimation::ErrorModel error;
  error.closed_loop = closed_loop(subset);
  add_noise(error, model, subset);
  error.health_output.setZero(p, n + t);
  error.health_output.rightCols(t) = subset.W;
  error.auxiliary_output.setZero(r, n + t);
  error.auxiliary_output.leftCols(n) = model.F;
  error.auxiliary_output.rightCols(t) = model.N * subset.W;
  error.prediction = subset.C * subset.A;
  add_unknowns(error, model, steady, subset.K);
  error.health_scale = design.scaling.health;
  error.auxiliary_scale = design.scaling.auxiliary;
  error.sensor_scale = design.scaling.sensor;
  error.settling_samples = subset.settling_samples(design.model.sample_time_s);
  return error;
}

}  // namespace ehm::design
