#include "tuner_design/lyapunov.h"

#include <Eigen/Eigenvalues>
#include <sstream>
#include <stdexcept>

namespace ehm::bench {
namespace {

constexpr int max_doublings = 60;
constexpr double converged_change = 1e-16;
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
    throw std::runtime_error(message.str());
  }
  Eigen::MatrixXd Ak = A;
  Eigen::MatrixXd X = 0.5 * (Q + Q.transpose());
  for (int k = 0; k < max_doublings; ++k) {
    Eigen::MatrixXd increment = Ak * X * Ak.transpose();
    increment = (0.5 * (increment + increment.transpose())).eval();
    X += increment;
    if (increment.norm() <= converged_change * X.norm()) break;
    Ak = (Ak * Ak).eval();
  }
  const double size = X.norm();
  const double residual = (A * X * A.transpose() + Q - X).norm();
  if (!(residual <= allowed_residual * size)) {
    std::ostringstream message;
    message << "Lyapunov equation: residual " << residual << " of " << size << ", allowed " << allowed_residual
            << " relative; spectral radius " << radius;
    throw std::runtime_error(message.str());
  }
  return X;
}

}  // namespace ehm::bench
