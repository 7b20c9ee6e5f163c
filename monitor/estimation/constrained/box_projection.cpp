// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/constrained/box_projection.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/index.h"

namespace ehm::estimation {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_violation = 1e-12;  ///< standard deviations; less is roundoff
constexpr double least_freedom = 1e-12;    ///< of a variance, that the active bounds must leave of it
constexpr int most_steps = 16 * max_health;

/// The bounds that hold with equality, their signs (+1 lower, -1 upper) and multipliers s_j mu_j >= 0.
class ActiveSet {
 public:
  ActiveSet(const HealthCovariance& P, const HealthVector& lower, const HealthVector& upper) noexcept
      : P_(P), lower_(lower), upper_(upper) {}

  int count() const noexcept { return count_; }
  /// P_SS^-1 v
  HealthVector solve(HealthVector v) const noexcept {
    HealthCovariance root(count_, count_);
    for (Eigen::Index a = 0; a < count_; ++a)
      for (Eigen::Index b = 0; b < count_; ++b) root(a, b) = P_(at(a), at(b));
    root.llt().solveInPlace(v);
    return v;
  }
  /// P_Si
  HealthVector column(Eigen::Index i) const noexcept {
    HealthVector v(count_);
    for (Eigen::Index a = 0; a < count_; ++a) v(a) = P_(at(a), i);
    return v;
  }
  /// v + P_:S mu
  HealthVector moved(HealthVector v, const HealthVector& mu) const noexcept {
    for (Eigen::Index a = 0; a < count_; ++a) v += mu(a) * P_.col(at(a));
    return v;
  }
  double bound(Eigen::Index a) const noexcept { return sign(a) > 0.0 ? lower_(at(a)) : upper_(at(a)); }
  Eigen::Index at(Eigen::Index a) const noexcept { return index_[as_size(a)]; }
  double sign(Eigen::Index a) const noexcept { return sign_[as_size(a)]; }
  double& multiplier(Eigen::Index a) noexcept { return multiplier_[as_size(a)]; }

  void add(Eigen::Index i, double sign, double multiplier) noexcept {
    const std::size_t end = as_size(count_++);
    index_[end] = i;
    sign_[end] = sign;
    multiplier_[end] = multiplier;
  }
  void drop(Eigen::Index a) noexcept {
    const std::size_t gone = as_size(a), last = as_size(--count_);
    index_[gone] = index_[last];
    sign_[gone] = sign_[last];
    multiplier_[gone] = multiplier_[last];
  }

 private:
  const HealthCovariance& P_;
  const HealthVector &lower_, &upper_;
  std::array<Eigen::Index, max_health> index_{};
  std::array<double, max_health> sign_{}, multiplier_{};
  int count_ = 0;
};

struct Violation {
  Eigen::Index at = -1;  ///< -1: none
  double sign = 0.0, size = 0.0;
};

Violation worst(const HealthCovariance& P, const HealthVector& lower, const HealthVector& upper,
                const HealthVector& x) noexcept {
  Violation worst;
  double most_sigmas = least_violation;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double below = lower(i) - x(i), above = x(i) - upper(i), size = std::max(below, above);
    if (!(size > 0.0)) continue;
    const double sigmas = P(i, i) > 0.0 ? size / std::sqrt(P(i, i)) : infinite;
    if (sigmas <= most_sigmas) continue;
    most_sigmas = sigmas;
    worst = {i, below > above ? 1.0 : -1.0, size};
  }
  return worst;
}

/// Lets bound `v` in, and drops what stands in its way. Counts `steps` down.
BoxSolution let_in(const HealthCovariance& P, Violation v, ActiveSet& set, HealthVector& x, int& steps) noexcept {
  double multiplier = 0.0;
  while (steps-- > 0) {
    const HealthVector column = set.column(v.at), r = set.solve(column);
    const double freedom = P(v.at, v.at) - column.dot(r);
    const bool free = freedom > least_freedom * P(v.at, v.at);
    const double whole = free ? v.size / freedom : infinite;
    double step = whole;
    Eigen::Index blocking = -1;
    for (Eigen::Index a = 0; a < set.count(); ++a) {
      const double fall = v.sign * set.sign(a) * r(a);
      if (fall <= 0.0 || set.multiplier(a) / fall >= step) continue;
      step = set.multiplier(a) / fall;
      blocking = a;
    }
    if (step == infinite) return BoxSolution::infeasible;
    for (Eigen::Index a = 0; a < set.count(); ++a) set.multiplier(a) -= step * v.sign * set.sign(a) * r(a);
    multiplier += step;
    if (free) {
      x = set.moved(x + step * v.sign * P.col(v.at), -step * v.sign * r);
      v.size -= step * freedom;
    }
    if (blocking < 0) {
      set.add(v.at, v.sign, multiplier);
      return BoxSolution::found;
    }
    set.drop(blocking);
  }
  return BoxSolution::unfinished;
}

}  // namespace

BoxSolution project_onto_box(const HealthCovariance& P, const HealthVector& lower, const HealthVector& upper,
                             HealthVector& x) noexcept {
  if (!x.allFinite() || !P.allFinite() || !(lower.array() <= upper.array()).all()) return BoxSolution::infeasible;
  ActiveSet set(P, lower, upper);
  HealthVector moving = x;
  int steps = most_steps;
  for (Violation v = worst(P, lower, upper, moving); v.at >= 0; v = worst(P, lower, upper, moving)) {
    if (!(P(v.at, v.at) > 0.0)) return BoxSolution::infeasible;
    const BoxSolution step = let_in(P, v, set, moving, steps);
    if (step != BoxSolution::found) return step;
  }
  // Once more from xhat, so that nothing of the way there is left in the solution.
  HealthVector miss(set.count());
  for (Eigen::Index a = 0; a < set.count(); ++a) miss(a) = set.bound(a) - x(set.at(a));
  x = clamped_to_box(set.moved(x, set.solve(miss)), lower, upper);
  for (Eigen::Index a = 0; a < set.count(); ++a) x(set.at(a)) = set.bound(a);
  return BoxSolution::found;
}

}  // namespace ehm::estimation
