// SPDX-License-Identifier: Apache-2.0
#pragma once
// One reading taken into a Gaussian, in the form that keeps P symmetric to the last bit:
//   s = c'P c + r,   b = P c/sqrt(s),   x <- x + b e/sqrt(s),   P <- P - b b'
// Shapes: c n, P n x n. One after the other where R is diagonal: no inverse. Source: Bierman, Factorization Methods for
// Discrete Sequential Estimation, ch. II. Errors: none; r > 0. Real-time safe: yes.

#include <cmath>

#include "monitor/nonlinear/state_space.h"

namespace ehm::nonlinear {

/// @returns by how much the state moves for an innovation of 1
inline OrderVector take_in(const OrderVector& slopes, double variance, OrderMatrix& covariance) noexcept {
  OrderVector b = covariance * slopes;
  const double root = std::sqrt(slopes.dot(b) + variance);
  b /= root;
  covariance.noalias() -= b * b.transpose();
  return b / root;
}

/// F P F' + Q
inline OrderMatrix carried(const OrderMatrix& f, const OrderMatrix& covariance,
                           const OrderVector& process_variance) noexcept {
  const OrderMatrix moved = f * covariance;
  const OrderMatrix full = moved * f.transpose();
  OrderMatrix p = 0.5 * (full + full.transpose());
  p.diagonal() += process_variance;
  return p;
}

}  // namespace ehm::nonlinear
