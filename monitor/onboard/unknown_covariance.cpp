// SPDX-License-Identifier: Apache-2.0
#include "monitor/onboard/unknown_covariance.h"

#include <cmath>

namespace ehm::onboard {

void UnknownCovariance::predict(const EngineTangent& tangent, const StepSize& step) noexcept {
  const Eigen::Matrix2d f = tangent.speed_rates();
  EngineTangent::Rates top = step.dt_s * (tangent.rates() + 0.5 * step.dt_s * f * tangent.rates());
  top.leftCols<speed_count>() += Eigen::Matrix2d::Identity();
  const EngineTangent::Rates moved = top * p_;
  const Eigen::Matrix2d speeds = moved * top.transpose();
  p_.topRows<speed_count>() = moved;
  p_.leftCols<speed_count>() = moved.transpose();
  p_.topLeftCorner<speed_count, speed_count>() = 0.5 * (speeds + speeds.transpose());
  p_.diagonal().head<speed_count>().array() += step.speed_variance;
  p_.diagonal().segment(UnknownLayout::first_health(), layout_.health_count).array() += step.health_variance;
  if (step.memory == 1.0) return;
  const Eigen::Index m = layout_.sensor_count;
  p_.bottomRows(m) *= step.memory;
  p_.rightCols(m) *= step.memory;
  p_.diagonal().tail(m) += (1.0 - step.memory * step.memory) * tangent.path_variance();
}

UnknownVector UnknownCovariance::update(const UnknownVector& row, double noise_variance, bool teach) noexcept {
  const UnknownVector g = p_ * row;
  const double s = row.dot(g) + noise_variance;
  UnknownVector k = g / s;
  if (teach) {  // k g' + g k' - s k k' = g g'/s
    const UnknownVector half = g / std::sqrt(s);
    p_.noalias() -= half * half.transpose();
    return k;
  }
  k.tail(k.size() - speed_count).setZero();
  p_ -= (k * g.transpose() + g * k.transpose() - s * k * k.transpose()).eval();
  return k;
}

}  // namespace ehm::onboard
