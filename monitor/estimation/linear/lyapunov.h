// SPDX-License-Identifier: Apache-2.0
#pragma once
// Discrete Lyapunov equation X = A X A^T + Q, A n x n with spectral radius below 1, Q n x n symmetric.
// Solved by Smith doubling, quadratically convergent: X+ = X + A X A^T, A+ = A A, from X = Q.
// Source: Smith, SIAM J. Appl. Math. 16 (1968) 198.

#include <Eigen/Core>

namespace ehm::estimation {

/// @throws std::invalid_argument if the shapes do not fit.
/// @throws SolverError if A is not stable, or if the relative residual exceeds 1e-9 (it is in the message).
Eigen::MatrixXd solve_discrete_lyapunov(const Eigen::MatrixXd& A, const Eigen::MatrixXd& Q);

/// Largest magnitude of an eigenvalue.
double spectral_radius(const Eigen::MatrixXd& A);

}  // namespace ehm::estimation
