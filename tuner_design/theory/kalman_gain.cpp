// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/theory/kalman_gain.h"

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/estimation/linear/riccati.h"
#include "tuner_design/theory/map_estimator.h"

namespace ehm::tuner_design {

design::SubsetDesign kalman_gain(const linear_model::LinearModel& model, const std::vector<int>& sensors,
                                 const Eigen::MatrixXd& V, double qh_percent2) {
  const Eigen::Index n = model.A.rows(), nu = model.B.cols(), m = model.C.rows(), t = V.rows();
  design::SubsetDesign design;
  design.sensors = sensors;
  design.V = V;
  design.W = right_inverse(V);
  design.health_readout = design.W;
  design.auxiliary_readout = model.N * design.W;
  design.A.setIdentity(n + t, n + t);
  design.A.topLeftCorner(n, n) = model.A;
  design.A.topRightCorner(n, t) = model.L * design.W;
  design.B.setZero(n + t, nu);
  design.B.topRows(n) = model.B;
  design.C.resize(m, n + t);
  design.C << model.C, model.M * design.W;

  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(n + t, n + t);
  Q.topLeftCorner(n, n) = model.process_noise;
  Q.bottomRightCorner(t, t) = qh_percent2 * V * V.transpose();
  const Eigen::MatrixXd C = design.C(sensors, Eigen::all);
  const Eigen::MatrixXd R = model.sensor_noise_sigma(sensors).cwiseAbs2().asDiagonal();
  design.P = estimation::solve_filter_riccati(design.A, C, Q, R);

  // Kinf^T = (C P C^T + R)^-1 C P
  const Eigen::MatrixXd CP = C * design.P;
  design.K.setZero(n + t, m);
  design.K(Eigen::all, sensors) = (CP * C.transpose() + R).llt().solve(CP).transpose();
  return design;
}

}  // namespace ehm::tuner_design
