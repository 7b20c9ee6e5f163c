// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/snapshot/one_snapshot.h"

#include <utility>

#include "deploy/runtime/numbers/index.h"

namespace ehm::estimation {

OneSnapshot::OneSnapshot(std::shared_ptr<const SnapshotModel> model, SnapshotWay way) noexcept
    : model_(std::move(model)), way_(way) {
  reset();
}

std::unique_ptr<SnapshotMethod> OneSnapshot::fresh() const {
  return std::make_unique<OneSnapshot>(model_, way_);
}

void OneSnapshot::reset() noexcept {
  sensors_.reset();
  health_.setZero(model_->health());
  error_ = nothing_seen(*model_);
}

void OneSnapshot::pass(int samples) noexcept {
  for (int k = 0; k < samples; ++k) move_on(*model_, error_);
}

bool OneSnapshot::update(const SensorVector& readings, SensorMask fused) noexcept {
  if (fused.none()) return false;
  if (fused != sensors_) {
    gain_ = way_ == SnapshotWay::map ? map_gain(*model_, fused) : least_squares_gain(*model_, fused);
    error_ = error_of(*model_, gain_);
    motion_cross_ = error_.motion_cross;
    sensors_ = fused;
  }
  error_.motion_cross = motion_cross_;
  health_.setZero();
  // Chosen, not multiplied by zero: a sensor without a value has NaN here.
  for (Eigen::Index i = 0; i < readings.size(); ++i)
    if (fused[as_size(i)]) health_ += gain_.col(i) * readings(i);
  return true;
}

bool OneSnapshot::restore(const HealthVector& health, const SnapshotError& error) noexcept {
  sensors_.reset();
  health_ = health;
  error_ = error;
  return true;
}

HealthCovariance OneSnapshot::own_covariance() const noexcept {
  return way_ == SnapshotWay::map ? estimation::health_covariance(error_, 1.0) : error_.noise;
}

}  // namespace ehm::estimation
