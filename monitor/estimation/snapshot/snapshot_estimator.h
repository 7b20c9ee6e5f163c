// SPDX-License-Identifier: Apache-2.0
#pragma once
// The estimators on snapshots, the practice before Kalman filters, as Estimators: map, wls (one_snapshot.h) and rls
// (recursive_least_squares.h). They take the engine for one in balance, but for what its actuators do, which the linear
// model tells and which is taken out of each sample (snapshot_model.h); so the first sample stands for an engine in
// balance at its first actuators. The method makes health of the rest, and
//
//   health = trim + scale sigma_h hhat,  z = trim + scale (F xu + G u + Hz hhat),  nu = scale sigma_y (e - Hn hhat)
//
// hhat of nu is that of the samples before. Sigmas are those of the whole error over the fleet (snapshot_error.h). With
// wls and map a sensor that repeats its value (hold) is missing from the samples between; where all are, the estimate
// stands for so long, and holds. Any sensors will do, by masks.
//
// A state is [xu; hhat], hhat in sigmas of the fleet, with the error in the places of M and S. Errors: none after
// construction. Real-time safe: yes, all but construction and clone().

#include <memory>

#include "monitor/estimation/channel_units.h"
#include "monitor/estimation/estimator.h"
#include "monitor/estimation/point_distance.h"
#include "monitor/estimation/snapshot/snapshot_method.h"

namespace ehm::estimation {

struct SnapshotSetting {
  std::shared_ptr<const SnapshotModel> model;
  ChannelUnits units;
  int settling_samples = 1;  ///< with a reading, until an engine of the fleet is known as well as its start allows
};

class SnapshotEstimator final : public Estimator {
 public:
  /// `method` is of the setting's model, and has seen nothing.
  SnapshotEstimator(std::shared_ptr<const SnapshotSetting> setting, std::unique_ptr<SnapshotMethod> method,
                    const PointDistance& distance);

  [[nodiscard]] std::unique_ptr<Estimator> clone() const override;
  void reset() noexcept override;
  bool use(SensorMask available) noexcept override;
  void predict(const Conditions& before, int steps) noexcept override;
  void innovate(const SensorVector& y, const Conditions& now) noexcept override;
  void update(SensorMask fused, std::int64_t hold) noexcept override;
  void widen(double excess) noexcept override;
  void save(EstimatorState& state) const noexcept override;
  bool restore(const EstimatorState& state) noexcept override;
  [[nodiscard]] HealthCovariance health_covariance() const noexcept override;
  bool correct_health(const HealthVector& health) noexcept override;
  [[nodiscard]] double distance(const Conditions& conditions) const noexcept override {
    return distance_.of(conditions);
  }
  [[nodiscard]] const Innovation& innovation() const noexcept override { return innovation_; }
  [[nodiscard]] const Estimate& estimate() const noexcept override { return estimate_; }

 private:
  void read_out() noexcept;
  void read_out_sigmas() noexcept;
  HealthVector health_scale() const noexcept;

  std::shared_ptr<const SnapshotSetting> setting_;
  std::unique_ptr<SnapshotMethod> method_;
  PointDistance distance_;
  SensorMask all_;
  ActuatorVector du_;
  StateVector controls_;   ///< xu
  SensorVector readings_;  ///< e
  double excess_ = 1.0;
  bool begun_ = false;           ///< the first sample has been
  std::int64_t unanswered_ = 0;  ///< samples since the estimate, where the method has none of its own
  int remaining_ = 0;            ///< samples until it counts as settled
  Innovation innovation_;
  Estimate estimate_;
};

}  // namespace ehm::estimation
