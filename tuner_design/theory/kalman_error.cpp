// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/theory/kalman_error.h"

#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/design/fleet_unknowns.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "monitor/estimation/linear/solver_error.h"
#include "tuner_design/theory/read_out.h"

namespace ehm::tuner_design {
namespace {

using linear_model::LinearModel;

/// Closed loop of the filter, its response to the true engine, and its noise.
struct ClosedLoop {
  Eigen::MatrixXd mean;     ///< X, (n+t) x k: E[xhat] per unknown of the fleet
  Eigen::MatrixXd noise;    ///< S
  Eigen::MatrixXd updated;  ///< P+
  double radius = 0.0;
};

/// (I - K C) blkdiag(Q, 0) (I - K C)^T, symmetric.
Eigen::MatrixXd process_noise_of(const Eigen::MatrixXd& I_KC, const Eigen::MatrixXd& Q) {
  const Eigen::MatrixXd entry = I_KC.leftCols(Q.rows());
  return entry * Q * entry.transpose();
}

ClosedLoop closed_loop(const design::SubsetDesign& design, const LinearModel& model, const Eigen::MatrixXd& Gy) {
  const Eigen::VectorXd& sigma = model.sensor_noise_sigma;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(design.A.rows(), design.A.cols());
  const Eigen::MatrixXd I_KC = identity - design.K * design.C;
  const Eigen::MatrixXd Acl = I_KC * design.A;
  const Eigen::MatrixXd KRK = design.K * sigma.cwiseAbs2().asDiagonal() * design.K.transpose();
  const Eigen::MatrixXd KG = design.K * Gy;
  ClosedLoop loop;
  loop.radius = estimation::spectral_radius(Acl);
  loop.mean = (identity - Acl).partialPivLu().solve(KG);
  const double residual = ((identity - Acl) * loop.mean - KG).norm();
  if (!(residual <= 1e-9 * (loop.mean.norm() + KG.norm()))) {
    throw estimation::SolverError("mean of the filter, (I - Acl) X = Kinf Gy: residual " + std::to_string(residual));
  }
  loop.noise = estimation::solve_discrete_lyapunov(Acl, KRK + process_noise_of(I_KC, model.process_noise));
  loop.updated = I_KC * design.P * I_KC.transpose() + KRK;
  return loop;
}

Eigen::MatrixXd seen_through(const Eigen::MatrixXd& T, const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd result = T * covariance * T.transpose();
  return 0.5 * (result + result.transpose());
}

/// B B^T of the columns of B.
Eigen::MatrixXd square(const Eigen::MatrixXd& B) {
  return seen_through(B, Eigen::MatrixXd::Identity(B.cols(), B.cols()));
}

/// Rh and Rz of least error.
void add_read_out(design::SubsetDesign& design, const LinearModel& model, const ClosedLoop& loop,
                  const design::FleetUnknowns& unknowns) {
  const Eigen::Index n = model.A.rows(), p = model.L.cols(), r = model.F.rows(), t = design.V.rows();
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(p + r, n + t);
  T.bottomLeftCorner(r, n) = model.F;
  if (!set_read_out(T, loop.mean, loop.noise, unknowns.health, unknowns.auxiliary, t))
    throw estimation::SolverError("read-out of the tuners: their covariance over the fleet is not positive definite");
  design.health_readout = T.topRightCorner(p, t);
  design.auxiliary_readout = T.bottomRightCorner(r, t);
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
  const design::FleetUnknowns unknowns = design::fleet_unknowns(model, steady);
  const ClosedLoop loop = closed_loop(design, model, unknowns.sensors);
  if (model.linearisation_error.size() > 0) add_read_out(design, model, loop, unknowns);

  Eigen::MatrixXd Th = Eigen::MatrixXd::Zero(p, n + t);  // Th = [0, Rh]
  Th.rightCols(t) = design.health_readout;
  Eigen::MatrixXd Tz(r, n + t);  // Tz = [F, Rz]
  Tz << model.F, design.auxiliary_readout;
  design.health_noise_covariance = seen_through(Th, loop.noise);
  design.auxiliary_noise_covariance = seen_through(Tz, loop.noise);
  design.health_filter_covariance = seen_through(Th, loop.updated);
  design.auxiliary_filter_covariance = seen_through(Tz, loop.updated);
  // The first p unknowns are health, the others the linearisation error. Squares of a root: a z that is a sensor but for
  // its sign (an EGT margin) has nothing left here but round-off, which as a sum of squares is not negative.
  const Eigen::MatrixXd h = Th * loop.mean - unknowns.health, z = Tz * loop.mean - unknowns.auxiliary;
  const Eigen::Index more = unknowns.health.cols() - p;
  design.health_linearisation_covariance = square(h.rightCols(more));
  design.auxiliary_linearisation_covariance = square(z.rightCols(more));
  design.health_total_covariance =
      square(h.leftCols(p)) + design.health_noise_covariance + design.health_linearisation_covariance;
  design.auxiliary_total_covariance =
      square(z.leftCols(p)) + design.auxiliary_noise_covariance + design.auxiliary_linearisation_covariance;
  require_variances(design.health_noise_covariance, "health estimate");
  require_variances(design.auxiliary_noise_covariance, "auxiliary estimate");

  // diag(C P C^T + R), and the bias of the sensors that nothing corrects
  design.innovation_variance = seen_through(design.C, design.P).diagonal() + model.sensor_noise_sigma.cwiseAbs2();
  const Eigen::MatrixXd y = design.C * loop.mean - unknowns.sensors;
  const Eigen::VectorXd bias = y.leftCols(p).rowwise().squaredNorm();
  std::vector<bool> used(model.sensors.size(), false);
  for (const int sensor : design.sensors) used[as_size(sensor)] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const auto at = as_index(i);
    if (!used[i]) design.innovation_variance(at) += bias(at);
  }
  design.slowest_time_constant_s = -model.sample_time_s / std::log(loop.radius);
}

}  // namespace ehm::tuner_design
