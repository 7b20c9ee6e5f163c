// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/linear/lyapunov.h"

#include <sstream>
#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/estimation/linear/doubling.h"
#include "monitor/estimation/linear/solver_error.h"

namespace ehm::estimation {
namespace {

constexpr double allowed_residual = 1e-9;

}  // namespace

double spectral_radius(const Eigen::MatrixXd& A) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues().cwiseAbs().maxCoeff();
}

Eigen::MatrixXd solve_discrete_lyapunov(const Eigen::MatrixXd& A, const Eigen::MatrixXd& Q) {
  if (A.rows() != A.cols() || Q.rows() != A.rows() || Q.cols() != A.rows()) {
    throw std::invalid_argument("Lyapunov equation: A and Q must be square and of one size");
  }
  const double radius = spectral_radius(A);
  if (!(radius < 1.0)) {
    std::ostringstream message;
    message << "Lyapunov equation: A has the spectral radius " << radius << ", allowed below 1";
    throw SolverError(message.str());
  }
  const doubling::Powers<Eigen::MatrixXd> powers(A);
  Eigen::MatrixXd X = 0.5 * (Q + Q.transpose());
  powers.solve(X);
  const double size = X.norm();
  const double residual = (A * X * A.transpose() + Q - X).norm();
  if (!powers.converged() || !(residual <= allowed_residual * size)) {
    std::ostringstream message;
    message << "Lyapunov equation: residual " << residual << " of " << size << ", allowed " << allowed_residual
            << " relative; spectral radius " << radius;
    throw SolverError(message.str());
  }
  return X;
}

}  // namespace ehm::estimation
