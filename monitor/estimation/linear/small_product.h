// SPDX-License-Identifier: Apache-2.0
#pragma once
// Products of small column-major matrices sized at run time, without allocation: out = A B, and A S A^T with symmetric
// S. Four rows and two columns at a time stay in registers; Eigen's own product of this size spends more on packing or
// on looking up coefficients (theory.md, section 10; tests/bench/design_bench.cpp compares). `out` must not be an
// operand. Shapes: inner sizes must agree (asserted). Errors: none.

#include <Eigen/Core>

namespace ehm::estimation {
namespace small_product {

/// Rows i .. i+Rows-1 of columns j .. j+Cols-1.
template <int Rows, int Cols, typename Out, typename Left, typename Right>
inline void tile(Out& out, const Left& left, const Right& right, Eigen::Index i, Eigen::Index j) {
  using Tile = Eigen::Matrix<double, Rows, 1>;
  Tile sum[Cols];
  for (auto& column : sum) column.setZero();
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    const Tile factor = left.template block<Rows, 1>(i, k);
    for (int c = 0; c < Cols; ++c) sum[c] += right.coeff(k, j + c) * factor;
  }
  for (int c = 0; c < Cols; ++c) out.template block<Rows, 1>(i, j + c) = sum[c];
}

/// Columns j .. j+Cols-1 from row `first` on.
template <int Cols, typename Out, typename Left, typename Right>
inline void columns(Out& out, const Left& left, const Right& right, Eigen::Index j, Eigen::Index first) {
  Eigen::Index i = first;
  const Eigen::Index rows = left.rows();
  for (; i + 4 <= rows; i += 4) tile<4, Cols>(out, left, right, i, j);
  if (i + 2 <= rows) tile<2, Cols>(out, left, right, i, j), i += 2;
  if (i < rows) tile<1, Cols>(out, left, right, i, j);
}

}  // namespace small_product

/// out = left right; `right` may be a transpose.
template <typename Out, typename Left, typename Right>
void multiply(Out& out, const Left& left, const Right& right) {
  eigen_assert(left.cols() == right.rows());
  out.resize(left.rows(), right.cols());
  Eigen::Index j = 0;
  for (; j + 2 <= right.cols(); j += 2) small_product::columns<2>(out, left, right, j, 0);
  if (j < right.cols()) small_product::columns<1>(out, left, right, j, 0);
}

/// out = left right where that is known to be symmetric: the lower triangle is computed, and mirrored.
template <typename Out, typename Left, typename Right>
void multiply_symmetric(Out& out, const Left& left, const Right& right) {
  eigen_assert(left.cols() == right.rows() && left.rows() == right.cols());
  const Eigen::Index n = left.rows();
  out.resize(n, n);
  Eigen::Index j = 0;
  for (; j + 2 <= n; j += 2) small_product::columns<2>(out, left, right, j, j);
  if (j < n) small_product::columns<1>(out, left, right, j, j);
  for (j = 1; j < n; ++j) {
    for (Eigen::Index i = 0; i < j; ++i) out(i, j) = out(j, i);
  }
}

}  // namespace ehm::estimation
