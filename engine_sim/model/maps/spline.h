// SPDX-License-Identifier: Apache-2.0
#pragma once
// Cubic B-splines: f(x) = sum_i c_i b_i(x), and the tensor product f(x, y) = sum_ij c_ij b_i(x) b_j(y).
// Twice continuously differentiable between the first and the last knot; beyond them each basis function continues
// along its tangent, so f is continued linearly (C1) and Newton's method never meets a wall.
// Shapes: `breaks` holds k+1 ascending break points; k+3 coefficients per dimension (the end knots are fourfold).
// Units: those of the caller. Source: de Boor, A Practical Guide to Splines, chapter IX (recurrence), X (derivative).

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace ehm::engine_sim {

/// The four basis functions that differ from zero at one place, the index of the first, and their slopes.
struct BasisValues {
  std::size_t first;
  Eigen::Vector4d b;
  Eigen::Vector4d slope;
};

class SplineBasis {
 public:
  /// @throws std::invalid_argument if there are fewer than two break points or they do not ascend strictly
  explicit SplineBasis(std::span<const double> breaks);
  std::size_t size() const { return intervals_.size() + 3; }
  double lowest() const { return breaks_.front(); }
  double highest() const { return breaks_.back(); }
  /// Real-time safe: yes.
  BasisValues at(double x) const;

 private:
  /// Between two break points b = sum of column k of `powers` times u^k, u = (x - left)/width: the recurrence is run
  /// only once.
  struct Interval {
    double left, width;
    Eigen::Matrix4d powers;
  };
  std::vector<double> breaks_;
  std::vector<Interval> intervals_;
};

struct SurfaceValue {
  double f;
  double by_x;
  double by_y;
};

/// sum over the 4 x 4 patch; `coefficients` is row-major, one row per x basis function, `columns` = size of the y
/// basis.
SurfaceValue surface(const BasisValues& x, const BasisValues& y, std::span<const double> coefficients,
                     std::size_t columns);

}  // namespace ehm::engine_sim
