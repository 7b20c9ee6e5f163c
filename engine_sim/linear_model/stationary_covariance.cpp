// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/linear_model/stationary_covariance.h"

#include <sstream>
#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"

namespace ehm::linear_model {
namespace {

constexpr double allowed_residual = 1e-9;
constexpr double vanished = 1e-20;  ///< power of A whose further increments are beyond rounding
constexpr int most_doublings = 64;  ///< spectral radius 1 - 1e-17: never reached by a stable A in double precision

}  // namespace

Eigen::MatrixXd stationary_covariance(const Eigen::MatrixXd& A, const Eigen::MatrixXd& Q) {
  Eigen::MatrixXd power = A, X = Q;
  for (int i = 0; i < most_doublings && power.cwiseAbs().maxCoeff() > vanished; ++i) {
    X += (power * X * power.transpose()).eval();
    power = (power * power).eval();
  }
  X = (0.5 * (X + X.transpose())).eval();
  const double residual = (A * X * A.transpose() + Q - X).norm(), size = X.norm();
  if (!(residual <= allowed_residual * size)) {
    std::ostringstream message;
    message << "stationary covariance, X = A X A^T + Q: residual " << residual << " of " << size << ", allowed "
            << allowed_residual << " relative; A is not stable, or nearly so";
    throw std::runtime_error(message.str());
  }
  return X;
}

Eigen::MatrixXd covariance_root(const Eigen::MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

}  // namespace ehm::linear_model
