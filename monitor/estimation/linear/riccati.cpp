// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/linear/riccati.h"

#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/estimation/linear/doubling.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "monitor/estimation/linear/solver_error.h"

namespace ehm::estimation {
namespace {

constexpr double allowed_residual = 1e-9;
constexpr double good_residual = 1e-13;  // Newton's iteration has nothing to add
constexpr int max_newton_steps = 6;

void check_shapes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, const Eigen::MatrixXd& Q,
                  const Eigen::MatrixXd& R) {
  const Eigen::Index n = A.rows(), m = C.rows();
  if (A.cols() == n && C.cols() == n && Q.rows() == n && Q.cols() == n && R.rows() == m && R.cols() == m) return;
  throw std::invalid_argument("Riccati equation: A must be n x n, C m x n, Q n x n, R m x m");
}

/// One step of Newton's iteration; nullopt if the gain of P does not stabilise.
std::optional<Eigen::MatrixXd> newton_step(const Eigen::MatrixXd& P, const Eigen::MatrixXd& A, const Eigen::MatrixXd& C,
                                           const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R) {
  const Eigen::MatrixXd CP = C * P;
  const Eigen::LLT<Eigen::MatrixXd> innovation(CP * C.transpose() + R);
  if (innovation.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd AK = A * innovation.solve(CP).transpose();
  const Eigen::MatrixXd F = A - AK * C;
  if (!F.allFinite() || !(spectral_radius(F) < 1.0)) return std::nullopt;
  try {
    return solve_discrete_lyapunov(F, AK * R * AK.transpose() + Q);
  } catch (const SolverError&) {
    return std::nullopt;
  }
}

}  // namespace

double riccati_residual(const Eigen::MatrixXd& P, const Eigen::MatrixXd& A, const Eigen::MatrixXd& C,
                        const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R) {
  const Eigen::MatrixXd CPA = C * P * A.transpose();
  const Eigen::MatrixXd correction = CPA.transpose() * (C * P * C.transpose() + R).llt().solve(CPA);
  return (A * P * A.transpose() - correction + Q - P).norm() / P.norm();
}

Eigen::MatrixXd solve_filter_riccati(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, const Eigen::MatrixXd& Q,
                                     const Eigen::MatrixXd& R) {
  check_shapes(A, C, Q, R);
  const Eigen::LLT<Eigen::MatrixXd> factor_R(R);
  if (factor_R.info() != Eigen::Success) throw SolverError("Riccati equation: R is not positive definite");
  const Eigen::MatrixXd information = C.transpose() * factor_R.solve(C);
  Eigen::MatrixXd P = 0.5 * (Q + Q.transpose());
  const bool converged = doubling::solve_riccati(A, Eigen::MatrixXd(0.5 * (information + information.transpose())), P);
  double residual = P.allFinite() ? riccati_residual(P, A, C, Q, R) : -1.0;
  for (int i = 0; i < max_newton_steps && residual > good_residual; ++i) {
    const std::optional<Eigen::MatrixXd> next = newton_step(P, A, C, Q, R);
    const double left = next ? riccati_residual(*next, A, C, Q, R) : residual;
    if (!(left < residual)) break;
    P = *next;
    residual = left;
  }
  if (!converged || !(residual >= 0.0 && residual <= allowed_residual)) {
    std::ostringstream message;
    message << "Riccati equation (" << A.rows() << " states, " << C.rows() << " sensors): ";
    if (converged) {
      message << "relative residual " << residual << ", allowed " << allowed_residual
              << "; the digits of double do not suffice: the noise of the sensors, from "
              << std::sqrt(R.diagonal().minCoeff()) << " to " << std::sqrt(R.diagonal().maxCoeff())
              << " percent, is too small or too different. Check its unit";
    } else {
      message << "no convergence, relative residual " << residual << ", allowed " << allowed_residual
              << "; the pair (A, C) is not detectable or Q leaves a unit eigenvalue undriven";
    }
    throw SolverError(message.str());
  }
  return P;
}

}  // namespace ehm::estimation
