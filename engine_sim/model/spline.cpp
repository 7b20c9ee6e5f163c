#include "engine_sim/model/spline.h"

#include <algorithm>
#include <stdexcept>

namespace ehm::engine {

SplineBasis::SplineBasis(std::span<const double> breaks) {
  const bool ascending = std::adjacent_find(breaks.begin(), breaks.end(), std::greater_equal<>()) == breaks.end();
  if (breaks.size() < 2 || !ascending) {
    throw std::invalid_argument("spline: needs two or more strictly ascending break points");
  }
  knots_.assign(3, breaks.front());
  knots_.insert(knots_.end(), breaks.begin(), breaks.end());
  knots_.insert(knots_.end(), 3, breaks.back());
}

BasisValues SplineBasis::inside(double x) const {
  // interval knots_[m] <= x < knots_[m+1]; the last interval is closed
  const auto last = knots_.end() - 5;
  const auto above = std::upper_bound(knots_.begin() + 3, last + 1, x);
  const std::size_t m = std::min<std::size_t>(static_cast<std::size_t>(above - knots_.begin()) - 1, knots_.size() - 5);

  // Cox-de Boor, degree by degree; `quadratic` is kept for the slopes
  std::array<double, 4> b{1.0, 0.0, 0.0, 0.0};
  std::array<double, 4> quadratic{};
  for (std::size_t degree = 1; degree <= 3; ++degree) {
    if (degree == 3) quadratic = b;
    double carried = 0.0;
    for (std::size_t r = 0; r < degree; ++r) {
      const double right = knots_[m + 1 + r], left = knots_[m + 1 + r - degree];
      const double share = b[r] / (right - left);
      b[r] = carried + (right - x) * share;
      carried = (x - left) * share;
    }
    b[degree] = carried;
  }
  // b_i' = 3 (q_i / (t_{i+3} - t_i) - q_{i+1} / (t_{i+4} - t_{i+1})), q of degree 2
  std::array<double, 4> slope{};
  for (std::size_t r = 0; r < 3; ++r) {
    const double share = 3.0 * quadratic[r] / (knots_[m + 1 + r] - knots_[m - 2 + r]);
    slope[r] -= share;
    slope[r + 1] += share;
  }
  return {m - 3, b, slope};
}

BasisValues SplineBasis::at(double x) const {
  const double clamped = std::clamp(x, lowest(), highest());
  BasisValues out = inside(clamped);
  if (x != clamped) {
    for (std::size_t i = 0; i < 4; ++i) out.b[i] += out.slope[i] * (x - clamped);
  }
  return out;
}

SurfaceValue surface(const BasisValues& x, const BasisValues& y, std::span<const double> coefficients,
                     std::size_t columns) {
  SurfaceValue out{0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 4; ++i) {
    const double* row = coefficients.data() + (x.first + i) * columns + y.first;
    double along = 0.0, along_slope = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      along += row[j] * y.b[j];
      along_slope += row[j] * y.slope[j];
    }
    out.f += x.b[i] * along;
    out.by_x += x.slope[i] * along;
    out.by_y += x.b[i] * along_slope;
  }
  return out;
}

}  // namespace ehm::engine
