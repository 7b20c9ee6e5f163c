// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/theory/bayes_limit.h"

#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"
#include "tuner_design/theory/observability.h"

namespace ehm::tuner_design {

namespace {

/// N for Gy.
Eigen::MatrixXd unseen(const Eigen::MatrixXd& Gy) {
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(Gy, Eigen::ComputeFullV);
  svd.setThreshold(Observability::relative_tolerance);
  return svd.matrixV().rightCols(Gy.cols() - svd.rank());
}

}  // namespace

Eigen::MatrixXd bayes_limit_factor(const Eigen::MatrixXd& H, const Eigen::MatrixXd& Ph) {
  const Eigen::LLT<Eigen::MatrixXd> factor(Ph);
  if (factor.info() != Eigen::Success) throw std::runtime_error("Bayes limit: Ph is not positive definite");
  const Eigen::MatrixXd L = factor.matrixL();
  return L * unseen(H * L);
}

design::ErrorByChannel steady_limit(const design::FleetUnknowns& unknowns) {
  const Eigen::MatrixXd N = unseen(unknowns.sensors);
  return {(unknowns.health * N).rowwise().squaredNorm(), (unknowns.auxiliary * N).rowwise().squaredNorm()};
}

}  // namespace ehm::tuner_design
