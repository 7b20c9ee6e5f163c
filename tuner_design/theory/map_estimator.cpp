// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/theory/map_estimator.h"

#include <stdexcept>
#include <string>

#include "deploy/runtime/numbers/decompositions.h"

namespace ehm::tuner_design {
namespace {

Eigen::LLT<Eigen::MatrixXd> factorised(const Eigen::MatrixXd& matrix, const char* name) {
  Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  if (factor.info() != Eigen::Success) {
    throw std::runtime_error(std::string("MAP estimator: ") + name + " is not positive definite");
  }
  return factor;
}

}  // namespace

Eigen::MatrixXd right_inverse(const Eigen::MatrixXd& V) {
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(V);
  if (decomposition.rank() < V.rows()) {
    throw std::invalid_argument("tuner matrix V has rank " + std::to_string(decomposition.rank()) + ", expected " +
                                std::to_string(V.rows()));
  }
  return decomposition.pseudoInverse();
}

Eigen::MatrixXd full_map_gain(const Eigen::MatrixXd& H, const Eigen::MatrixXd& Ph, const Eigen::MatrixXd& R) {
  const Eigen::MatrixXd HPh = H * Ph;
  // E^T = (H Ph H^T + R)^-1 H Ph
  return factorised(HPh * H.transpose() + R, "H Ph H^T + R").solve(HPh).transpose();
}

Eigen::MatrixXd reduced_map_gain(const Eigen::MatrixXd& H, const Eigen::MatrixXd& Ph, const Eigen::MatrixXd& R,
                                 const Eigen::MatrixXd& V) {
  const Eigen::MatrixXd W = right_inverse(V);
  const Eigen::MatrixXd Hq = H * W;
  const Eigen::MatrixXd Pq = V * Ph * V.transpose();
  const Eigen::MatrixXd RinvHq = factorised(R, "R").solve(Hq);
  const Eigen::MatrixXd prior = factorised(Pq, "V Ph V^T").solve(Eigen::MatrixXd::Identity(Pq.rows(), Pq.cols()));
  // Kq = (Pq^-1 + Hq^T R^-1 Hq)^-1 Hq^T R^-1
  const Eigen::MatrixXd Kq =
      factorised(prior + Hq.transpose() * RinvHq, "Pq^-1 + Hq^T R^-1 Hq").solve(RinvHq.transpose());
  return W * Kq;
}

Eigen::MatrixXd snapshot_error_covariance(const Eigen::MatrixXd& E, const Eigen::MatrixXd& H, const Eigen::MatrixXd& Ph,
                                          const Eigen::MatrixXd& R) {
  const Eigen::MatrixXd bias = E * H - Eigen::MatrixXd::Identity(Ph.rows(), Ph.cols());
  return bias * Ph * bias.transpose() + E * R * E.transpose();
}

}  // namespace ehm::tuner_design
