// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/gauss_markov_design.h"

#include <cmath>
#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/design/closed_loop.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "monitor/estimation/linear/riccati.h"

namespace ehm::design {
namespace {

constexpr double seen = 1e-6;  // of the largest singular value; less is not told apart from nothing

Eigen::MatrixXd rows(const Eigen::MatrixXd& matrix, const std::vector<int>& chosen) {
  Eigen::MatrixXd some(as_index(chosen.size()), matrix.cols());
  for (std::size_t i = 0; i < chosen.size(); ++i) some.row(as_index(i)) = matrix.row(chosen[i]);
  return some;
}

/// Spectral radius of the closed loop on all that the sensors see.
double seen_radius(const SubsetDesign& design, const linear_model::LinearModel& model, double rho) {
  const Eigen::Index n = model.A.rows(), p = model.L.cols();
  const Eigen::MatrixXd answer = (rho * Eigen::MatrixXd::Identity(n, n) - model.A).partialPivLu().solve(model.L);
  const Eigen::MatrixXd H_rho = model.C * answer + model.M;
  const Eigen::MatrixXd signal =
      model.sensor_noise_sigma.cwiseInverse().asDiagonal() * H_rho * model.health_sigma.asDiagonal();
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows(signal, design.sensors), Eigen::ComputeFullV);
  svd.setThreshold(seen);
  const Eigen::Index unseen = p - svd.rank();
  const Eigen::MatrixXd Acl = closed_loop(design);
  if (unseen == 0) return estimation::spectral_radius(Acl);
  Eigen::MatrixXd modes(n + p, unseen);
  const Eigen::MatrixXd kernel = model.health_sigma.asDiagonal() * svd.matrixV().rightCols(unseen);
  modes << answer * kernel, kernel;
  // Acl leaves the span of `modes` where it is, so its other eigenvalues are those of its complement's corner.
  const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(modes).householderQ();
  const Eigen::MatrixXd rest = basis.rightCols(n + p - unseen);
  return estimation::spectral_radius(rest.transpose() * Acl * rest);
}

/// P and K.
void add_gain(SubsetDesign& design, const linear_model::LinearModel& model, double rho) {
  const Eigen::Index n = model.A.rows(), p = model.L.cols();
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(n + p, n + p);
  Q.topLeftCorner(n, n) = model.process_noise;
  Q.bottomRightCorner(p, p) = (1.0 - rho * rho) * model.health_sigma.cwiseAbs2().asDiagonal().toDenseMatrix();
  const Eigen::MatrixXd C = rows(design.C, design.sensors);
  const Eigen::MatrixXd R =
      rows(model.sensor_noise_sigma, design.sensors).col(0).cwiseAbs2().asDiagonal().toDenseMatrix();
  design.P = estimation::solve_filter_riccati(design.A, C, Q, R);
  // K^T = (C P C^T + R)^-1 C P
  const Eigen::MatrixXd CP = C * design.P;
  const Eigen::MatrixXd K = (CP * C.transpose() + R).llt().solve(CP).transpose();
  design.K = Eigen::MatrixXd::Zero(n + p, model.C.rows());
  for (std::size_t i = 0; i < design.sensors.size(); ++i) design.K.col(design.sensors[i]) = K.col(as_index(i));
}

}  // namespace

double rho_of(double memory_s, double sample_time_s) noexcept {
  return std::exp(-sample_time_s / memory_s);
}

SubsetDesign gauss_markov_filter(const linear_model::LinearModel& model, const std::vector<int>& sensors, double rho) {
  if (!(rho > 0.0 && rho < 1.0)) {
    throw std::invalid_argument("Gauss-Markov filter: rho is " + std::to_string(rho) +
                                "; allowed: above 0 and below 1");
  }
  const Eigen::Index n = model.A.rows(), p = model.L.cols();
  SubsetDesign design;
  design.sensors = sensors;
  design.V.setIdentity(p, p);
  design.W = design.V;
  design.health_readout = design.W;
  design.auxiliary_readout = model.N;
  design.A = rho * Eigen::MatrixXd::Identity(n + p, n + p);
  design.A.topRows(n) << model.A, model.L;
  design.B = Eigen::MatrixXd::Zero(n + p, model.B.cols());
  design.B.topRows(n) = model.B;
  design.C.resize(model.C.rows(), n + p);
  design.C << model.C, model.M;
  add_gain(design, model, rho);
  design.slowest_time_constant_s = -model.sample_time_s / std::log(seen_radius(design, model, rho));
  return design;
}

}  // namespace ehm::design
