// SPDX-License-Identifier: Apache-2.0
#pragma once
// The time-varying Kalman filter on all n + p states as an Estimator: no linear estimator knows more of an engine whose
// health stays, after the same samples, and none is deafer to a health that changes. Any sensors will do. Its total
// sigma is that of its own covariance and of the engine's nonlinearity (time_varying_filter.h).

#include <memory>

#include "monitor/estimation/channel_units.h"
#include "monitor/estimation/estimator.h"
#include "monitor/estimation/point_distance.h"
#include "monitor/estimation/time_varying_filter.h"

namespace ehm::estimation {

struct TimeVaryingModel {
  std::shared_ptr<const FullOrderModel> model;  ///< scaled
  ChannelUnits units;
  int settling_samples = 0;  ///< until an engine of the fleet is known as well as its start allows
};

class TimeVaryingEstimator final : public Estimator {
 public:
  TimeVaryingEstimator(std::shared_ptr<const TimeVaryingModel> model, const PointDistance& distance);

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
  /// The state moves by Pxh Phh^-1 dh.
  bool correct_health(const HealthVector& health) noexcept override;
  [[nodiscard]] double distance(const Conditions& conditions) const noexcept override {
    return distance_.of(conditions);
  }
  [[nodiscard]] const Innovation& innovation() const noexcept override { return innovation_; }
  [[nodiscard]] const Estimate& estimate() const noexcept override { return estimate_; }

 private:
  void read_out() noexcept;

  std::shared_ptr<const TimeVaryingModel> model_;
  TimeVaryingFilter filter_;
  PointDistance distance_;
  SensorMask all_;
  ActuatorVector du_;
  double excess_ = 1.0;
  int remaining_ = 0;   ///< samples until it counts as settled
  bool begun_ = false;  ///< the prior is that of the first sample: no prediction leads to it
  Innovation innovation_;
  Estimate estimate_;
};

}  // namespace ehm::estimation
