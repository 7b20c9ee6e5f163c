// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/search/map_objective.h"

#include "deploy/runtime/numbers/decompositions.h"

namespace ehm::tuner_design {

std::optional<double> map_objective(const PointProblem& point, const Eigen::MatrixXd& V, Eigen::MatrixXd* gradient) {
  const Eigen::MatrixXd W = V.transpose();
  const Eigen::MatrixXd Hq = point.H * W, Pq = V * point.health_covariance * W;
  const Eigen::MatrixXd B = Pq * Hq.transpose();
  Eigen::MatrixXd S = Hq * B;
  S.diagonal() += point.sensor_variance;
  const Eigen::LLT<Eigen::MatrixXd> factor(S);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd Kq = factor.solve(B.transpose()).transpose();
  const Eigen::MatrixXd E = W * Kq;

  const Eigen::MatrixXd EGy = E * point.Gy;
  const Eigen::MatrixXd health_miss = EGy - point.Gh, auxiliary_miss = point.Hz * EGy - point.Gz;
  // T^T Omega D and T^T Omega T, p rows
  const Eigen::MatrixXd weighted_Hz = point.auxiliary_weight.asDiagonal() * point.Hz;
  const Eigen::MatrixXd weighted_miss = point.health_weight * health_miss + weighted_Hz.transpose() * auxiliary_miss;
  Eigen::MatrixXd weight = point.Hz.transpose() * weighted_Hz;
  weight.diagonal().array() += point.health_weight;
  const Eigen::MatrixXd weighted_ER = weight * E * point.sensor_variance.asDiagonal();
  const double value = point.health_weight * health_miss.squaredNorm() +
                       auxiliary_miss.cwiseProduct(point.auxiliary_weight.asDiagonal() * auxiliary_miss).sum() +
                       E.cwiseProduct(weighted_ER).sum();
  if (gradient == nullptr) return value;

  const Eigen::MatrixXd E_bar = 2.0 * (weighted_miss * point.Gy.transpose() + weighted_ER);
  const Eigen::MatrixXd through = factor.solve((W.transpose() * E_bar).transpose()).transpose();  // Kqb S^-1
  const Eigen::MatrixXd S_bar = -Kq.transpose() * through;
  const Eigen::MatrixXd B_bar = through + Hq.transpose() * S_bar;
  const Eigen::MatrixXd Hq_bar = S_bar * B.transpose() + B_bar.transpose() * Pq;
  const Eigen::MatrixXd Pq_bar = B_bar * Hq;
  Eigen::MatrixXd W_bar = E_bar * Kq.transpose() + point.H.transpose() * Hq_bar +
                          point.health_covariance * W * (Pq_bar + Pq_bar.transpose());
  W_bar -= W * (W.transpose() * W_bar);
  *gradient = W_bar.transpose();
  return value;
}

}  // namespace ehm::tuner_design
