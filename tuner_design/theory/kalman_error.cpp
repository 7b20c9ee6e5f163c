// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/theory/kalman_error.h"

#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "monitor/estimation/linear/solver_error.h"

namespace ehm::tuner_design {
namespace {

using linear_model::LinearModel;

/// Closed loop of the filter, its response to the true engine, and its noise.
struct ClosedLoop {
  Eigen::MatrixXd mean;     ///< (n+t) x p: E[xhat] per unit of health
  Eigen::MatrixXd noise;    ///< S
  Eigen::MatrixXd offset;   ///< (n+t) x m: E[xhat] per unit of constant sensor offset
  Eigen::MatrixXd updated;  ///< P+
  double radius = 0.0;
};

/// (I - K C) blkdiag(Q, 0) (I - K C)^T, symmetric.
Eigen::MatrixXd process_noise_of(const Eigen::MatrixXd& I_KC, const Eigen::MatrixXd& Q) {
  const Eigen::MatrixXd entry = I_KC.leftCols(Q.rows());
  return entry * Q * entry.transpose();
}

ClosedLoop closed_loop(const design::SubsetDesign& design, const LinearModel& model, const Eigen::MatrixXd& H) {
  const Eigen::VectorXd& sigma = model.sensor_noise_sigma;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(design.A.rows(), design.A.cols());
  const Eigen::MatrixXd I_KC = identity - design.K * design.C;
  const Eigen::MatrixXd Acl = I_KC * design.A;
  const Eigen::MatrixXd KRK = design.K * sigma.cwiseAbs2().asDiagonal() * design.K.transpose();
  const Eigen::MatrixXd KH = design.K * H;
  ClosedLoop loop;
  loop.radius = estimation::spectral_radius(Acl);
  loop.mean = (identity - Acl).partialPivLu().solve(KH);
  const double residual = ((identity - Acl) * loop.mean - KH).norm();
  if (!(residual <= 1e-9 * (loop.mean.norm() + KH.norm()))) {
    throw estimation::SolverError("mean of the filter, (I - Acl) X = Kinf H: residual " + std::to_string(residual));
  }
  loop.offset = (identity - Acl).partialPivLu().solve(design.K);
  loop.noise = estimation::solve_discrete_lyapunov(Acl, KRK + process_noise_of(I_KC, model.process_noise));
  loop.updated = I_KC * design.P * I_KC.transpose() + KRK;
  return loop;
}

/// G Ph G^T with G = T mean - target.
Eigen::MatrixXd bias_covariance(const Eigen::MatrixXd& T, const ClosedLoop& loop, const Eigen::MatrixXd& target,
                                const Eigen::MatrixXd& Ph) {
  const Eigen::MatrixXd G = T * loop.mean - target;
  return G * Ph * G.transpose();
}

Eigen::MatrixXd seen_through(const Eigen::MatrixXd& T, const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd result = T * covariance * T.transpose();
  return 0.5 * (result + result.transpose());
}

/// [T offset, -z] Lambda [T offset, -z]^T: a linearisation error of the sensors moves the estimate, one of the outputs
/// z the truth. Through a root of Lambda, since a z that is a sensor but for its sign (an EGT margin) has nothing left
/// here but round-off, which as a sum of squares is not negative.
Eigen::MatrixXd linearisation_covariance(const Eigen::MatrixXd& T, const ClosedLoop& loop, const LinearModel& model,
                                         bool auxiliary) {
  const Eigen::Index rows = T.rows(), m = model.C.rows(), r = model.F.rows();
  if (model.linearisation_error.size() == 0) return Eigen::MatrixXd::Zero(rows, rows);
  Eigen::MatrixXd response = Eigen::MatrixXd::Zero(rows, m + r);
  response.leftCols(m) = T * loop.offset;
  if (auxiliary) response.rightCols(r) = -Eigen::MatrixXd::Identity(r, r);
  return seen_through(response * linear_model::covariance_root(model.linearisation_error),
                      Eigen::MatrixXd::Identity(m + r, m + r));
}

void require_variances(const Eigen::MatrixXd& covariance, const char* name) {
  if (covariance.size() == 0 || covariance.diagonal().minCoeff() >= 0.0) return;
  throw estimation::SolverError(std::string(name) + " has the negative variance " +
                                std::to_string(covariance.diagonal().minCoeff()));
}

}  // namespace

void add_error_theory(design::SubsetDesign& design, const linear_model::LinearModel& model,
                      const estimation::SteadyGain& steady) {
  const Eigen::Index n = model.A.rows(), p = model.L.cols(), r = model.F.rows(), t = design.V.rows();
  const Eigen::MatrixXd Ph = model.health_sigma.cwiseAbs2().asDiagonal();
  const ClosedLoop loop = closed_loop(design, model, steady.H);

  Eigen::MatrixXd Th = Eigen::MatrixXd::Zero(p, n + t);  // Th = [0, W]
  Th.rightCols(t) = design.W;
  Eigen::MatrixXd Tz(r, n + t);  // Tz = [F, N W]
  Tz << model.F, model.N * design.W;
  design.health_noise_covariance = seen_through(Th, loop.noise);
  design.auxiliary_noise_covariance = seen_through(Tz, loop.noise);
  design.health_filter_covariance = seen_through(Th, loop.updated);
  design.auxiliary_filter_covariance = seen_through(Tz, loop.updated);
  design.health_linearisation_covariance = linearisation_covariance(Th, loop, model, false);
  design.auxiliary_linearisation_covariance = linearisation_covariance(Tz, loop, model, true);
  design.health_total_covariance = bias_covariance(Th, loop, Eigen::MatrixXd::Identity(p, p), Ph) +
                                   design.health_noise_covariance + design.health_linearisation_covariance;
  design.auxiliary_total_covariance = bias_covariance(Tz, loop, steady.Hz, Ph) + design.auxiliary_noise_covariance +
                                      design.auxiliary_linearisation_covariance;
  require_variances(design.health_noise_covariance, "health estimate");
  require_variances(design.auxiliary_noise_covariance, "auxiliary estimate");

  // diag(C P C^T + R), and the bias of the sensors that nothing corrects
  design.innovation_variance = seen_through(design.C, design.P).diagonal() + model.sensor_noise_sigma.cwiseAbs2();
  const Eigen::VectorXd bias = bias_covariance(design.C, loop, steady.H, Ph).diagonal();
  std::vector<bool> used(model.sensors.size(), false);
  for (const int sensor : design.sensors) used[as_size(sensor)] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const auto at = as_index(i);
    if (!used[i]) design.innovation_variance(at) += bias(at);
  }
  design.slowest_time_constant_s = -model.sample_time_s / std::log(loop.radius);
}

}  // namespace ehm::tuner_design
