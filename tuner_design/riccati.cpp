#include "tuner_design/riccati.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <sstream>
#include <stdexcept>

namespace ehm::bench {
namespace {

constexpr int max_doublings = 60;
constexpr double converged_change = 1e-15;
constexpr double allowed_residual = 1e-9;

void check_shapes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, const Eigen::MatrixXd& Q,
                  const Eigen::MatrixXd& R) {
  const Eigen::Index n = A.rows(), m = C.rows();
  if (A.cols() == n && C.cols() == n && Q.rows() == n && Q.cols() == n && R.rows() == m && R.cols() == m) return;
  throw std::invalid_argument("Riccati equation: A must be n x n, C m x n, Q n x n, R m x m");
}

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& matrix) {
  return 0.5 * (matrix + matrix.transpose());
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
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(A.rows(), A.cols());
  Eigen::MatrixXd Ak = A.transpose();
  Eigen::MatrixXd Gk = symmetric(C.transpose() * factor_R.solve(C));
  Eigen::MatrixXd Hk = symmetric(Q);
  bool converged = false;
  for (int k = 0; k < max_doublings && !converged && Hk.allFinite(); ++k) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> W(identity + Gk * Hk);
    const Eigen::MatrixXd WA = W.solve(Ak);
    const Eigen::MatrixXd WG = W.solve(Gk);
    const Eigen::MatrixXd increment = symmetric(Ak.transpose() * Hk * WA);
    Gk = symmetric(Gk + Ak * WG * Ak.transpose());
    Hk += increment;
    Ak = Ak * WA;
    converged = increment.norm() <= converged_change * Hk.norm();
  }
  const double residual = Hk.allFinite() ? riccati_residual(Hk, A, C, Q, R) : -1.0;
  if (!converged || !(residual >= 0.0 && residual <= allowed_residual)) {
    std::ostringstream message;
    message << "Riccati equation (" << A.rows() << " states, " << C.rows()
            << " sensors): " << (converged ? "relative residual " : "no convergence, relative residual ") << residual
            << ", allowed " << allowed_residual
            << "; the pair (A, C) is not detectable or Q leaves a unit eigenvalue undriven";
    throw std::runtime_error(message.str());
  }
  return Hk;
}

}  // namespace ehm::bench
