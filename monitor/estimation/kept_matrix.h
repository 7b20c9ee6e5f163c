// SPDX-License-Identifier: Apache-2.0
#pragma once
// A matrix that an engine keeps from sample to sample, in memory of the engine's own size instead of the capacity's: a
// fleet holds many of them. Computed with is a bounded one on the stack (capacity.h), copied to and fro.
//
// Copies of one room allocate nothing. Real-time safe: yes, all but construction. Errors: none; keep() must fit (asserted).

#include <algorithm>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/capacity.h"

namespace ehm::estimation {

template <int MaxRows, int MaxCols>
class KeptMatrix {
 public:
  using Bounded = BoundedMatrix<MaxRows, MaxCols>;

  /// With room for matrices of up to so many elements.
  explicit KeptMatrix(Eigen::Index room) : values_(as_size(room)) {}

  void keep(const Bounded& matrix) noexcept {
    eigen_assert(as_size(matrix.size()) <= values_.size());
    rows_ = matrix.rows();
    cols_ = matrix.cols();
    std::copy_n(matrix.data(), matrix.size(), values_.begin());
  }
  Bounded load() const noexcept { return Eigen::Map<const Eigen::MatrixXd>(values_.data(), rows_, cols_); }

 private:
  std::vector<double> values_;  ///< column by column
  Eigen::Index rows_ = 0, cols_ = 0;
};

}  // namespace ehm::estimation
