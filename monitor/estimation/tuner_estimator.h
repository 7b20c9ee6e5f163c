// SPDX-License-Identifier: Apache-2.0
#pragma once
// The tuner filter as an Estimator: the steady-state Kalman filter on q = V* h of each sensor set (tuner_filter.h), the
// theory of its total error from the first sample on (error_propagation.h), and the trims that it deviates from. It has
// a design for all its sensors and, where that is observable, for all but one.
//
// The data path looks at this one whichever is published: its innovations gate the sensors, its signatures name faults.
// What only accommodation may do to it (switching with what a fault has put in, cycle/accommodation.h) stands apart.

#include <memory>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/error_propagation.h"
#include "monitor/estimation/estimator.h"
#include "monitor/estimation/point_distance.h"
#include "monitor/estimation/tuner_filter.h"

namespace ehm::estimation {

/// What all engines of one design share of it.
struct TunerEstimatorModel {
  TunerFilter filter;                                     ///< has seen nothing yet
  std::shared_ptr<const std::vector<ErrorModel>> errors;  ///< [0] full set, [1 + i] without sensor i
  SensorVector sensor_trim;
  ActuatorVector actuator_trim;
};

class TunerEstimator final : public Estimator {
 public:
  TunerEstimator(const TunerEstimatorModel& model, const PointDistance& distance);

  [[nodiscard]] std::unique_ptr<Estimator> clone() const override;
  void reset() noexcept override;
  bool use(SensorMask available) noexcept override;
  void predict(const Conditions& before, int steps) noexcept override;
  void innovate(const SensorVector& y, const Conditions& now) noexcept override;
  void update(SensorMask fused, std::int64_t hold) noexcept override;
  void widen(double excess) noexcept override;
  void save(EstimatorState& state) const noexcept override;
  bool restore(const EstimatorState& state) noexcept override;
  /// Its q cannot hold any health: correct_health stays false.
  [[nodiscard]] HealthCovariance health_covariance() const noexcept override { return error_.health_covariance(); }
  [[nodiscard]] double distance(const Conditions& conditions) const noexcept override {
    return distance_.of(conditions);
  }
  [[nodiscard]] const Innovation& innovation() const noexcept override { return innovation_; }
  [[nodiscard]] const Estimate& estimate() const noexcept override { return estimate_; }

  [[nodiscard]] const TunerFilter& filter() const noexcept { return filter_; }
  [[nodiscard]] const ErrorPropagation& error() const noexcept { return error_; }

  // Accommodation. Real-time safe: yes, all of them.
  /// Cold start without a sensor; with all, and false, if there is no design for that.
  bool start_without(int sensor) noexcept;
  /// Goes on without a sensor. With `knows_it` the estimates go on from where they are, without a step: what the sensor
  /// has taught stays true, and `fading` of it is lost with each sample.
  void leave_out(int sensor, bool knows_it, double fading) noexcept;
  /// Goes on with all sensors.
  void take_back() noexcept;
  /// Adds to [x; q], scaled: takes out what a fault has put in.
  void shift(const AugmentedVector& delta) noexcept { filter_.shift(delta); }
  /// What the present design predicts of a sensor from the estimate, deviation from trim.
  [[nodiscard]] double predicted(int sensor) const noexcept {
    return filter_.gain().C.row(sensor).dot(filter_.estimate());
  }

  /// Predicts only, with held actuators, `steps` times. Real-time safe: yes.
  void fly_blind(const ActuatorVector& actuators, std::uint64_t steps) noexcept;
  /// Samples after which nothing is left of a start.
  [[nodiscard]] int settling_samples() const noexcept { return errors_->front().settling_samples; }

 private:
  [[nodiscard]] const ErrorModel& error_model(int missing) const noexcept { return (*errors_)[as_size(1 + missing)]; }
  void read_out() noexcept;
  void read_out_sigmas() noexcept;

  TunerFilter filter_;
  std::shared_ptr<const std::vector<ErrorModel>> errors_;
  ErrorPropagation error_;
  PointDistance distance_;
  SensorVector sensor_trim_, dy_;
  ActuatorVector actuator_trim_, du_;
  std::int64_t held_samples_ = 0;  ///< since the error's theory went on
  Innovation innovation_;
  Estimate estimate_;
};

}  // namespace ehm::estimation
