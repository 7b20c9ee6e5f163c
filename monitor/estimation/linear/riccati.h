// SPDX-License-Identifier: Apache-2.0
#pragma once
// Filter form of the discrete algebraic Riccati equation:
//   P = A P A^T - A P C^T (C P C^T + R)^-1 C P A^T + Q        A n x n, C m x n, Q n x n >= 0, R m x m > 0
// Solved by the structure-preserving doubling algorithm, quadratically convergent:
//   A+ = A W^-1 A,  G+ = G + A W^-1 G A^T,  H+ = H + A^T H W^-1 A,  W = I + G H
// from A^T, C^T R^-1 C, Q; H tends to P. Where noise is so small beside the signal that I + G H loses digits, Newton's
// iteration puts them right: with K and F = A (I - K C) of the last P the next one solves the Lyapunov equation
// P = F P F^T + A K R K^T A^T + Q, of sums only, so that an error of K enters squared. Sources: Hewer, IEEE TAC 16
// (1971) 382; Chu, Fan, Lin & Wang, Int. J. Control 77 (2004) 767, SDA.

#include <Eigen/Core>

namespace ehm::estimation {

/// @throws std::invalid_argument if the shapes do not fit.
/// @throws SolverError if R is not positive definite, if the doubling does not converge (the pair is not
///         detectable or not stabilisable), or if the relative residual exceeds 1e-9; the figure is in the message.
Eigen::MatrixXd solve_filter_riccati(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, const Eigen::MatrixXd& Q,
                                     const Eigen::MatrixXd& R);

/// Relative residual of P in the equation above, Frobenius norm over the norm of P.
double riccati_residual(const Eigen::MatrixXd& P, const Eigen::MatrixXd& A, const Eigen::MatrixXd& C,
                        const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R);

}  // namespace ehm::estimation
