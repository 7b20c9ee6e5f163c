// SPDX-License-Identifier: Apache-2.0
#pragma once
// The doubling iterations behind riccati.h and lyapunov.h, for any matrix type: dynamic, or of fixed capacity (then
// nothing is allocated).
//   Riccati (SDA)     A+ = A W^-1 A,  G+ = G + A W^-1 G A^T,  H+ = H + A^T H W^-1 A,  W = I + G H
//                     from A^T, C^T R^-1 C, Q; H tends to P
//   Lyapunov (Smith)  X+ = X + A X A^T,  A+ = A A,  from X = Q; the powers A^(2^k) serve any number of right-hand
//                     sides, also of the transposed equation X = A^T X A + Q
// Both converge quadratically: an increment of relative size e is followed by one of size e^2, so that the iterations
// stop at 1e-9. Sources: see riccati.h and lyapunov.h. Errors: none; the caller judges the result.

#include <Eigen/LU>
#include <array>

#include "monitor/estimation/linear/small_product.h"

namespace ehm::estimation::doubling {

inline constexpr int max_doublings = 48;  ///< radius 1 - 1e-13
inline constexpr double last_increment = 1e-9;

template <typename Matrix>
void symmetrise(Matrix& matrix) {
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) matrix(i, j) = matrix(j, i) = 0.5 * (matrix(i, j) + matrix(j, i));
  }
}

/// H <- P of P = A P A^T - A P C^T (C P C^T + R)^-1 C P A^T + Q, from A, G = C^T R^-1 C and H = Q.
/// @returns whether it converged.
template <typename Matrix>
bool solve_riccati(const Matrix& A, Matrix G, Matrix& H) {
  const Eigen::Index n = A.rows();
  Matrix Ak = A.transpose(), AkT = A, W, WA, WG, left, increment;
  for (int k = 0; k < max_doublings; ++k) {
    multiply(W, G, H);
    W.diagonal().array() += 1.0;
    const Eigen::PartialPivLU<Matrix> factor(W);
    WA = factor.solve(Ak);
    WG = factor.solve(G);
    multiply(left, AkT, H);
    multiply_symmetric(increment, left, WA);
    H += increment;
    if (!H.allFinite()) return false;
    if (increment.norm() <= last_increment * H.norm()) return true;
    multiply(left, Ak, WG);
    multiply_symmetric(increment, left, AkT);
    G += increment;
    multiply(left, Ak, WA);
    Ak = left;
    AkT.resize(n, n);
    AkT = Ak.transpose();
  }
  return false;
}

/// Powers A^(2^k) of a stable matrix as long as they matter.
template <typename Matrix>
class Powers {
 public:
  /// converged() is false afterwards if A is not stable.
  explicit Powers(const Matrix& A) {
    Matrix power = A;
    while (count_ < powers_.size()) {
      const double size = power.norm();
      if (!(size < 1e100)) return;
      if (size <= last_increment) {
        converged_ = true;
        return;
      }
      powers_[count_] = power;
      transposes_[count_] = power.transpose();
      multiply(power, powers_[count_], powers_[count_]);
      ++count_;
    }
  }
  [[nodiscard]] bool converged() const noexcept { return converged_; }

  /// X <- solution of X = A X A^T + X, X symmetric.
  void solve(Matrix& X) const { solve(X, powers_, transposes_); }
  /// X <- solution of X = A^T X A + X, X symmetric.
  void solve_transposed(Matrix& X) const { solve(X, transposes_, powers_); }

 private:
  using Sequence = std::array<Matrix, max_doublings>;
  void solve(Matrix& X, const Sequence& left, const Sequence& right) const {
    Matrix product, increment;
    for (std::size_t k = 0; k < count_; ++k) {
      multiply(product, left[k], X);
      multiply_symmetric(increment, product, right[k]);
      X += increment;
    }
  }

  Sequence powers_, transposes_;
  std::size_t count_ = 0;
  bool converged_ = false;
};

}  // namespace ehm::estimation::doubling
