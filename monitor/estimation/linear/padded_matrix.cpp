// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/linear/padded_matrix.h"

#include <utility>

#include "deploy/runtime/numbers/index.h"

namespace ehm::estimation {

bool has_wide_vectors() noexcept {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

/// One product for each number of groups, compiled for any processor of the architecture and, wide, for AVX2 without
/// fused multiply-add. Both are one text, inlined into each.
struct PaddedMatrix::Kernels {
  typedef double Four __attribute__((vector_size(32), may_alias));

  /// Passes by the columns of one factor; its elements are `each`. The loops over groups are unrolled, since only then
  /// the sums stay in registers.
  template <int Groups>
  [[gnu::always_inline]] static inline const Group* add(const Group* matrix, const double* each, Eigen::Index size,
                                                        Four (&sum)[Groups]) noexcept {
    for (Eigen::Index j = 0; j < size; ++j, matrix += Groups) {
#pragma GCC unroll 8
      for (int g = 0; g < Groups; ++g) sum[g] += reinterpret_cast<const Four*>(matrix)[g] * each[j];
    }
    return matrix;
  }
  template <int Groups>
  [[gnu::always_inline]] static inline void all(const Group* matrix, const double* from, const double* x,
                                                Eigen::Index x_size, const double* u, Eigen::Index u_size,
                                                double* y) noexcept {
    Four sum[Groups];
#pragma GCC unroll 8
    for (int g = 0; g < Groups; ++g) sum[g] = reinterpret_cast<const Four*>(from)[g];
    add<Groups>(add<Groups>(matrix, x, x_size, sum), u, u_size, sum);
#pragma GCC unroll 8
    for (int g = 0; g < Groups; ++g) reinterpret_cast<Four*>(y)[g] = sum[g];
  }

  template <int Groups>
  static void any(const Group* matrix, const double* from, const double* x, Eigen::Index x_size, const double* u,
                  Eigen::Index u_size, double* y) noexcept {
    all<Groups>(matrix, from, x, x_size, u, u_size, y);
  }
#ifdef __x86_64__
  template <int Groups>
  [[gnu::target("avx2")]] static void wide(const Group* matrix, const double* from, const double* x,
                                           Eigen::Index x_size, const double* u, Eigen::Index u_size,
                                           double* y) noexcept {
    all<Groups>(matrix, from, x, x_size, u, u_size, y);
  }
#else
  template <int Groups>
  static constexpr Kernel wide = &any<Groups>;
#endif

  static void nothing(const Group*, const double*, const double*, Eigen::Index, const double*, Eigen::Index,
                      double*) noexcept {}
  template <int... Less>
  static Kernel choose(std::size_t groups, bool wide_vectors, std::integer_sequence<int, Less...>) {
    static constexpr std::array<Kernel, sizeof...(Less) + 1> any_of{&nothing, &any<Less + 1>...};
    static constexpr std::array<Kernel, sizeof...(Less) + 1> wide_of{&nothing, &wide<Less + 1>...};
    return (wide_vectors ? wide_of : any_of)[groups];
  }
};

PaddedMatrix::PaddedMatrix(const Eigen::MatrixXd& M, bool wide_vectors) : columns_(M.cols()) {
  const Eigen::Index groups = (M.rows() + rows_of_group - 1) / rows_of_group;
  groups_.resize(as_size(groups * columns_));
  for (Eigen::Index j = 0; j < M.cols(); ++j)
    for (Eigen::Index i = 0; i < M.rows(); ++i)
      groups_[as_size(j * groups + i / rows_of_group)].row[as_size(i % rows_of_group)] = M(i, j);
  kernel_ = Kernels::choose(as_size(groups), wide_vectors, std::make_integer_sequence<int, most_groups>());
}

}  // namespace ehm::estimation
