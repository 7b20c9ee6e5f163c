// SPDX-License-Identifier: Apache-2.0
#pragma once
// Health from one sample alone: hhat = E e with the gain of map or of wls (snapshot_gain.h) for the sensors that this
// sample has. Nothing is kept of earlier samples but the latest estimate, which stands where a sample has no sensor.
// The gain and its error are those of the set of sensors: made anew when that changes.
//
// What it takes its error for: map the covariance of the posterior, which on the linear engine is the total; wls that
// of the noise, and so nothing of what it does not see. Errors: none. Real-time safe: yes, all but fresh().

#include "monitor/estimation/snapshot/snapshot_method.h"

namespace ehm::estimation {

enum class SnapshotWay { map, wls };

class OneSnapshot final : public SnapshotMethod {
 public:
  OneSnapshot(std::shared_ptr<const SnapshotModel> model, SnapshotWay way) noexcept;

  [[nodiscard]] std::unique_ptr<SnapshotMethod> fresh() const override;
  void reset() noexcept override;
  void pass(int samples) noexcept override;
  bool update(const SensorVector& readings, SensorMask fused) noexcept override;
  bool restore(const HealthVector& health, const SnapshotError& error) noexcept override;
  bool correct(const HealthVector&) noexcept override { return false; }
  [[nodiscard]] const HealthVector& health() const noexcept override { return health_; }
  [[nodiscard]] const SnapshotError& error() const noexcept override { return error_; }
  [[nodiscard]] HealthCovariance own_covariance() const noexcept override;

 private:
  std::shared_ptr<const SnapshotModel> model_;
  SnapshotWay way_;
  SensorMask sensors_;  ///< of the gain; none: there is no gain yet
  SnapshotGain gain_;
  BoundedMatrix<max_states, max_health> motion_cross_;  ///< Sx of that gain, at its sample
  HealthVector health_;
  SnapshotError error_;
};

}  // namespace ehm::estimation
