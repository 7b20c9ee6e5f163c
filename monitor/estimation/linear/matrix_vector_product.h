// SPDX-License-Identifier: Apache-2.0
#pragma once
// y += M x for the small matrices of the cycle path: M r x c, column-major, sized at run time, some ten rows and
// columns.
//
// Up to 16 rows are taken at once; their sums stay in registers while the columns pass by. Each row is summed column by
// column, so the result does not depend on the width of the machine's vectors. Eigen's own products of run-time size
// are made for larger matrices. Real-time safe: yes. Errors: none; M's sizes decide.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <utility>

#include "deploy/runtime/numbers/index.h"

namespace ehm::estimation {
namespace product_detail {

using RowsKernel = void (*)(const double* matrix, Eigen::Index stride, Eigen::Index columns, const double* x,
                            double* y) noexcept;

/// So many rows of the product. Pairs of rows fill a register; an odd row goes alone.
template <int Rows>
void add_rows(const double* matrix, Eigen::Index stride, Eigen::Index columns, const double* x, double* y) noexcept {
  using Paired = Eigen::Array<double, Rows / 2 * 2, 1>;
  constexpr bool odd = Rows % 2 == 1;
  Eigen::Map<Paired> paired(y);
  Paired sum = paired;
  double last = odd ? y[Rows - 1] : 0.0;
  for (Eigen::Index j = 0; j < columns; ++j, matrix += stride) {
    sum += Eigen::Map<const Paired>(matrix) * x[j];
    if constexpr (odd) last += matrix[Rows - 1] * x[j];
  }
  paired = sum;
  if constexpr (odd) y[Rows - 1] = last;
}

template <int... Less>
constexpr auto kernels(std::integer_sequence<int, Less...>) {
  return std::array<RowsKernel, sizeof...(Less)>{&add_rows<Less + 1>...};
}

inline constexpr int most_rows = 16;
inline constexpr auto kernel_of_rows = kernels(std::make_integer_sequence<int, most_rows>());

}  // namespace product_detail

/// `x` has M.cols() and `y` M.rows() elements; they do not overlap.
template <class Matrix>
void add_product(const Matrix& M, const double* x, double* y) noexcept {
  using namespace product_detail;
  const double* matrix = M.data();
  for (Eigen::Index left = M.rows(); left > 0; left -= most_rows, matrix += most_rows, y += most_rows)
    kernel_of_rows[as_size(std::min<Eigen::Index>(left, most_rows) - 1)](matrix, M.outerStride(), M.cols(), x, y);
}

}  // namespace ehm::estimation
