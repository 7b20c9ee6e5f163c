// SPDX-License-Identifier: Apache-2.0
#pragma once
// Covariance X of the stationary process x[k+1] = A x[k] + w[k], cov(w) = Q: the solution of
//
//   X = A X A^T + Q          A n x n with spectral radius below 1, Q n x n symmetric, X n x n symmetric
//
// by Smith doubling, X+ = X + A X A^T, A+ = A A, from X = Q, which converges quadratically. With Q = 0, X is 0 exactly.
// Source: Smith, SIAM J. Appl. Math. 16 (1968) 198.

#include <Eigen/Core>

namespace ehm::linear_model {

/// @throws std::runtime_error if A is not stable or the relative residual exceeds 1e-9 (the message tells it).
Eigen::MatrixXd stationary_covariance(const Eigen::MatrixXd& A, const Eigen::MatrixXd& Q);

/// A root of a covariance that may be singular: root root^T = covariance. Eigenvalues below 0 by round-off count as 0.
Eigen::MatrixXd covariance_root(const Eigen::MatrixXd& covariance);

}  // namespace ehm::linear_model
