// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/closed_loop.h"

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/estimation/linear/lyapunov.h"

namespace ehm::design {

Eigen::MatrixXd closed_loop(const SubsetDesign& subset) {
  return subset.A - subset.K * subset.C * subset.A;
}

Eigen::MatrixXd settled(const Eigen::MatrixXd& closed_loop, const Eigen::MatrixXd& drive) {
  const Eigen::Index size = closed_loop.rows();
  return (Eigen::MatrixXd::Identity(size, size) - closed_loop).partialPivLu().solve(drive);
}

Eigen::MatrixXd noise_of_a_sample(const SubsetDesign& subset, const linear_model::LinearModel& model) {
  const Eigen::MatrixXd entry = process_noise_entry(subset, model.A.rows());
  const Eigen::MatrixXd R = model.sensor_noise_sigma.cwiseAbs2().asDiagonal();
  return subset.K * R * subset.K.transpose() + entry * model.process_noise * entry.transpose();
}

Eigen::MatrixXd tuner_noise(const SubsetDesign& subset, const linear_model::LinearModel& model) {
  const Eigen::Index t = subset.V.rows();
  return estimation::solve_discrete_lyapunov(closed_loop(subset), noise_of_a_sample(subset, model))
      .bottomRightCorner(t, t);
}

Eigen::MatrixXd process_noise_entry(const SubsetDesign& subset, Eigen::Index n) {
  const Eigen::Index size = subset.A.rows();
  return (Eigen::MatrixXd::Identity(size, size) - subset.K * subset.C).leftCols(n);
}

}  // namespace ehm::design
