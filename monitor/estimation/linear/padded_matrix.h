// SPDX-License-Identifier: Apache-2.0
#pragma once
// y = from + M [x; u] for the small constant matrices of the cycle path, whose sizes are known at run time only.
//
// M's rows are padded with zeros to a multiple of four, and its columns lie in groups of four rows. Each group is
// summed in one register while the columns pass by, in their order: the sum does not depend on the width of the
// machine's vectors, so that a processor with AVX2 gives the bits of one without (no fused multiply-add). `from` and
// `y` have room for the padded rows, and are read and written in whole groups: a value that is stored in parts and
// loaded as one stalls the processor. Real-time safe: product yes. Errors: none; M's sizes decide.

#include <Eigen/Core>
#include <array>
#include <vector>

namespace ehm::estimation {

/// Whether this processor has the vectors of four that the products prefer.
bool has_wide_vectors() noexcept;

class PaddedMatrix {
 public:
  static constexpr Eigen::Index rows_of_group = 4, most_groups = 7;
  struct alignas(32) Group {
    std::array<double, rows_of_group> row{};
  };

  PaddedMatrix() = default;
  /// M has 28 rows at most.
  explicit PaddedMatrix(const Eigen::MatrixXd& M, bool wide_vectors = has_wide_vectors());

  /// `x` has `x_size` elements, `u` the rest of M's columns; `y` overlaps neither of them, but may be `from`. Both are
  /// aligned to 32 bytes.
  void product(const double* from, const double* x, Eigen::Index x_size, const double* u, double* y) const noexcept {
    kernel_(groups_.data(), from, x, x_size, u, columns_ - x_size, y);
  }

 private:
  using Kernel = void (*)(const Group* matrix, const double* from, const double* x, Eigen::Index x_size,
                          const double* u, Eigen::Index u_size, double* y) noexcept;
  struct Kernels;

  Eigen::Index columns_ = 0;
  std::vector<Group> groups_;  ///< column by column
  Kernel kernel_ = nullptr;
};

}  // namespace ehm::estimation
