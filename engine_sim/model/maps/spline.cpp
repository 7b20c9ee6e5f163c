// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/maps/spline.h"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>

#include "deploy/runtime/numbers/index.h"

namespace ehm::engine_sim {

namespace {

/// The four basis functions that live on knots[m] <= x <= knots[m+1], and their slopes.
BasisValues cox_de_boor(std::span<const double> knots, std::size_t m, double x) {
  // degree by degree; `quadratic` is kept for the slopes
  std::array<double, 4> b{1.0, 0.0, 0.0, 0.0};
  std::array<double, 4> quadratic{};
  for (std::size_t degree = 1; degree <= 3; ++degree) {
    if (degree == 3) quadratic = b;
    double carried = 0.0;
    for (std::size_t r = 0; r < degree; ++r) {
      const double right = knots[m + 1 + r], left = knots[m + 1 + r - degree];
      const double share = b[r] / (right - left);
      b[r] = carried + (right - x) * share;
      carried = (x - left) * share;
    }
    b[degree] = carried;
  }
  // b_i' = 3 (q_i / (t_{i+3} - t_i) - q_{i+1} / (t_{i+4} - t_{i+1})), q of degree 2
  std::array<double, 4> slope{};
  for (std::size_t r = 0; r < 3; ++r) {
    const double share = 3.0 * quadratic[r] / (knots[m + 1 + r] - knots[m - 2 + r]);
    slope[r] -= share;
    slope[r + 1] += share;
  }
  return {m - 3, Eigen::Vector4d(b.data()), Eigen::Vector4d(slope.data())};
}

}  // namespace

SplineBasis::SplineBasis(std::span<const double> breaks) : breaks_(breaks.begin(), breaks.end()) {
  const bool ascending = std::adjacent_find(breaks.begin(), breaks.end(), std::greater_equal<>()) == breaks.end();
  if (breaks.size() < 2 || !ascending) {
    throw std::invalid_argument("spline: needs two or more strictly ascending break points");
  }
  std::vector<double> knots(3, breaks.front());
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), 3, breaks.back());
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    // the cubic with the values and slopes of both ends
    const double width = breaks[i + 1] - breaks[i];
    const BasisValues p = cox_de_boor(knots, i + 3, breaks[i]), q = cox_de_boor(knots, i + 3, breaks[i + 1]);
    const Eigen::Vector4d rise = q.b - p.b, start = width * p.slope, end = width * q.slope;
    Interval interval{breaks[i], width, {}};
    interval.powers << p.b, start, 3.0 * rise - 2.0 * start - end, start + end - 2.0 * rise;
    intervals_.push_back(interval);
  }
}

BasisValues SplineBasis::at(double x) const {
  const double inside = std::clamp(x, lowest(), highest());
  const auto above = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, inside);
  const auto first = as_size(above - breaks_.begin()) - 1;
  const Interval& interval = intervals_[first];
  const double u = (inside - interval.left) / interval.width;
  const auto power = [&](Eigen::Index k) { return interval.powers.col(k); };
  const Eigen::Vector4d slope = ((3.0 * u * power(3) + 2.0 * power(2)) * u + power(1)) / interval.width;
  // beyond the ends along the tangent
  const Eigen::Vector4d b = ((u * power(3) + power(2)) * u + power(1)) * u + power(0) + (x - inside) * slope;
  return {first, b, slope};
}

SurfaceValue surface(const BasisValues& x, const BasisValues& y, std::span<const double> coefficients,
                     std::size_t columns) {
  Eigen::Vector4d along_y = Eigen::Vector4d::Zero(), slope_along_y = Eigen::Vector4d::Zero();
  for (Eigen::Index i = 0; i < 4; ++i) {
    const double* row = coefficients.data() + (x.first + as_size(i)) * columns + y.first;
    along_y += x.b[i] * Eigen::Vector4d::Map(row);
    slope_along_y += x.slope[i] * Eigen::Vector4d::Map(row);
  }
  return {along_y.dot(y.b), slope_along_y.dot(y.b), along_y.dot(y.slope)};
}

}  // namespace ehm::engine_sim
