// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/theory/bayes_limit.h"

#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"
#include "tuner_design/theory/observability.h"

namespace ehm::tuner_design {

Eigen::MatrixXd bayes_limit_factor(const Eigen::MatrixXd& H, const Eigen::MatrixXd& Ph) {
  const Eigen::LLT<Eigen::MatrixXd> factor(Ph);
  if (factor.info() != Eigen::Success) throw std::runtime_error("Bayes limit: Ph is not positive definite");
  const Eigen::MatrixXd L = factor.matrixL();
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(H * L, Eigen::ComputeFullV);
  svd.setThreshold(Observability::relative_tolerance);
  return L * svd.matrixV().rightCols(Ph.rows() - svd.rank());
}

}  // namespace ehm::tuner_design
