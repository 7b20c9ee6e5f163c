// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>

#include "monitor/onboard/on_board_estimator.h"

namespace ehm::onboard {

estimation::HealthCovariance OnBoardEstimator::health_covariance() const noexcept {
  const Eigen::Index first = UnknownLayout::first_health(), p = layout_.health_count;
  return (1e-4 * excess_) * covariance_.matrix().block(first, first, p, p);  // fractions
}

bool OnBoardEstimator::correct_health(const estimation::HealthVector& health) noexcept {
  const Eigen::Index first = UnknownLayout::first_health(), p = layout_.health_count;
  const estimation::HealthVector miss = 100.0 * health - xi_.segment(first, p);
  const estimation::HealthCovariance own = covariance_.matrix().block(first, first, p, p);
  const estimation::HealthVector weight = own.ldlt().solve(miss);
  UnknownVector change = covariance_.matrix().middleCols(first, p) * weight;
  change.segment(first, p) = miss;
  shift_unknowns(change);
  rates_ += tangent_.rates() * change;
  set_metal();
  moved_ += change;
  read_out(moved_);
  return true;
}

}  // namespace ehm::onboard
