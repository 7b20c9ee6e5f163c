// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/design/shared_tuners.h"

#include <stdexcept>
#include <string>

#include "deploy/runtime/numbers/decompositions.h"
#include "tuner_design/search/row_space.h"
#include "tuner_design/theory/map_estimator.h"

namespace ehm::tuner_design {
namespace {

/// A^-1 B for a covariance A.
Eigen::MatrixXd solved(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("one V* for several points: H Ph H^T + N of a point is not positive definite");
  return factor.solve(B);
}

}  // namespace

Eigen::MatrixXd shared_tuners(const std::vector<PointReadings>& points, const Eigen::VectorXd& health_sigma,
                              Eigen::Index t) {
  const Eigen::Index p = health_sigma.size();
  if (points.empty() || t < 1 || t > p) {
    throw std::invalid_argument("one V* for several points: " + std::to_string(points.size()) + " points and " +
                                std::to_string(t) + " tuners; allowed are a point or more, 1 to " + std::to_string(p) +
                                " tuners");
  }
  if (t == p) return Eigen::MatrixXd::Identity(p, p);
  Eigen::MatrixXd told = Eigen::MatrixXd::Zero(p, p);
  for (const PointReadings& point : points) {
    const Eigen::MatrixXd H = point.H * health_sigma.asDiagonal();
    told += point.weight * H.transpose() * solved(H * H.transpose() + point.noise, H);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(told);  // eigenvalues ascend
  return row_space(spectrum.eigenvectors().rightCols(t).transpose() * health_sigma.asDiagonal());
}

double steady_error_on(const Eigen::MatrixXd& V, const PointReadings& point, const Eigen::VectorXd& health_sigma) {
  const Eigen::MatrixXd W = right_inverse(V), Hq = point.H * W;
  const auto Ph = health_sigma.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd CHq = V * Ph * V.transpose() * Hq.transpose();
  const Eigen::MatrixXd E = W * solved(Hq * CHq + point.noise, CHq.transpose()).transpose();
  const Eigen::MatrixXd bias = E * point.H - Eigen::MatrixXd::Identity(V.cols(), V.cols());
  return (bias * Ph * bias.transpose()).trace() + (E * point.noise * E.transpose()).trace();
}

}  // namespace ehm::tuner_design
