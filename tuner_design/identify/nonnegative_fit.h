// SPDX-License-Identifier: Apache-2.0
#pragma once
// Least squares without negative unknowns, from its normal equations:
//
//   least of 1/2 x^T F x - b^T x over x >= 0            F k x k symmetric, positive semidefinite, b k
//
// by the active set method of Lawson & Hanson (Solving Least Squares Problems, 1974, ch. 23): unknowns join the free
// ones while their slope is downhill, and leave when they would turn negative. A ridge of 1e-12 on the scaled diagonal
// settles what F does not tell apart. Errors: none; F with a diagonal above 0.

#include <Eigen/Core>

namespace ehm::tuner_design {

Eigen::VectorXd nonnegative_fit(const Eigen::MatrixXd& F, const Eigen::VectorXd& b);

}  // namespace ehm::tuner_design
