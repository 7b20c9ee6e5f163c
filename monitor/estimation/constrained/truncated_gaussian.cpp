// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/constrained/truncated_gaussian.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ehm::estimation {
namespace {

/// Gauss-Legendre rule of 24 points on [-1, 1], the half above zero: where, weight.
constexpr std::array<std::array<double, 2>, 12> rule{{{0.06405689286260563, 0.12793819534675221},
                                                      {0.19111886747361631, 0.1258374563468283},
                                                      {0.3150426796961634, 0.12167047292780342},
                                                      {0.43379350762604513, 0.11550566805372561},
                                                      {0.54542147138883956, 0.10744427011596561},
                                                      {0.64809365193697555, 0.097618652104114065},
                                                      {0.74012419157855436, 0.086190161531953288},
                                                      {0.82000198597390295, 0.073346481411080411},
                                                      {0.88641552700440096, 0.059298584915436742},
                                                      {0.9382745520027328, 0.044277438817419551},
                                                      {0.97472855597130947, 0.028531388628933743},
                                                      {0.99518721999702131, 0.012341229799987091}}};
constexpr double least_exponent = 40.0;  ///< the density below e^-40 of its greatest value does not count

/// The density e^(-slope t - t^2/2), t from 0 to `length`, as points with weights; t counts into `direction`.
class Side {
 public:
  Side(double slope, double length, double direction) noexcept : direction_(direction) {
    if (!(length > 0.0)) return;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto& [where, weight] = rule[i / 2];
      const double t = 0.5 * length * (i % 2 == 0 ? 1.0 + where : 1.0 - where);
      points_[i] = {t, 0.5 * length * weight * std::exp(-t * (slope + 0.5 * t))};
    }
  }
  double mass() const noexcept {
    return sum([](double) { return 1.0; });
  }
  double first() const noexcept {
    return sum([](double t) { return t; });
  }
  double second_about(double centre) const noexcept {
    return sum([&](double t) { return (t - centre) * (t - centre); });
  }

 private:
  struct Point {
    double t = 0.0, weight = 0.0;
  };
  template <class Function>
  double sum(Function function) const noexcept {
    double sum = 0.0;
    for (const Point& p : points_) sum += p.weight * function(direction_ * p.t);
    return sum;
  }

  double direction_;
  std::array<Point, 2 * rule.size()> points_{};
};

}  // namespace

TruncatedMoments truncated_moments(double low, double high) noexcept {
  const double reach = std::sqrt(2.0 * least_exponent);
  if (low <= -reach && high >= reach) return {};
  const double mode = std::clamp(0.0, low, high), slope = std::abs(mode);
  // t with slope t + t^2/2 = least_exponent
  const double longest = 2.0 * least_exponent / (slope + std::sqrt(slope * slope + 2.0 * least_exponent));
  const Side above(slope, std::min(high - mode, longest), 1.0), below(slope, std::min(mode - low, longest), -1.0);
  const double mass = above.mass() + below.mass();
  if (!(mass > 0.0)) return {mode, 0.0};  // low = high
  const double centre = (above.first() + below.first()) / mass;
  return {mode + centre, (above.second_about(centre) + below.second_about(centre)) / mass};
}

bool truncate_to_box(const HealthVector& lower, const HealthVector& upper, HealthVector& x,
                     HealthCovariance& P) noexcept {
  if (!x.allFinite() || !P.allFinite() || !(lower.array() <= upper.array()).all()) return false;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (!(P(i, i) > 0.0)) continue;
    const double sigma = std::sqrt(P(i, i));
    const TruncatedMoments u = truncated_moments((lower(i) - x(i)) / sigma, (upper(i) - x(i)) / sigma);
    const HealthVector along = P.col(i) / sigma;
    x += u.mean * along;
    // P <- P - b b^T, symmetric because b_i b_j = b_j b_i also in floating point
    const HealthVector lost = std::sqrt(std::max(0.0, 1.0 - u.variance)) * along;
    for (Eigen::Index j = 0; j < x.size(); ++j) P.col(j) -= lost * lost(j);
  }
  return true;
}

}  // namespace ehm::estimation
