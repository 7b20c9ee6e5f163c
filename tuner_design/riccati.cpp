#include "tuner_design/riccati.h"

#include <Eigen/Cholesky>
#include <sstream>
#include <stdexcept>

#include "tuner_design/doubling.h"

namespace ehm::bench {
namespace {

constexpr double allowed_residual = 1e-9;

void check_shapes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, const Eigen::MatrixXd& Q,
                  const Eigen::MatrixXd& R) {
  const Eigen::Index n = A.rows(), m = C.rows();
  if (A.cols() == n && C.cols() == n && Q.rows() == n && Q.cols() == n && R.rows() == m && R.cols() == m) return;
  throw std::invalid_argument("Riccati equation: A must be n x n, C m x n, Q n x n, R m x m");
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
  if (factor_R.info() != Eigen::Success) throw std::runtime_error("Riccati equation: R is not positive definite");
  const Eigen::MatrixXd information = C.transpose() * factor_R.solve(C);
  Eigen::MatrixXd P = 0.5 * (Q + Q.transpose());
  const bool converged = doubling::solve_riccati(A, Eigen::MatrixXd(0.5 * (information + information.transpose())), P);
  const double residual = P.allFinite() ? riccati_residual(P, A, C, Q, R) : -1.0;
  if (!converged || !(residual >= 0.0 && residual <= allowed_residual)) {
    std::ostringstream message;
    message << "Riccati equation (" << A.rows() << " states, " << C.rows()
            << " sensors): " << (converged ? "relative residual " : "no convergence, relative residual ") << residual
            << ", allowed " << allowed_residual
            << "; the pair (A, C) is not detectable or Q leaves a unit eigenvalue undriven";
    throw std::runtime_error(message.str());
  }
  return P;
}

}  // namespace ehm::bench
