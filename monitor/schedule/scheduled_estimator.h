// SPDX-License-Identifier: Apache-2.0
#pragma once
// The Kalman filter on a schedule of point models, in absolute form, so that nothing jumps between nodes:
//
//   place  = (N1hat/sqrt(theta), M, theta, delta)      all of the table from there, at each sample
//   x-     = x + dt f + dt^2/2 A f,   f = A (x - x0) + B (u - u0) + L h + d_x
//   y^     = y0 + C (x - x0) + D (u - u0) + M h + d,   lagged like its sensor
//   z      = z0 + F (x - x0) + G (u - u0) + N h,       sigma_z^2 = Z P Z' + lambda_z^2 + (gamma_z eta)^2
//   xi = [x; h; d_x; d]:  P <- Phi P Phi' + Q;  readings one by one,  r_i = sigma_i^2 + (a tr Ph/tr Ph(fleet))^2
//                                                                    + (gamma_i eta)^2 (1 + 2 tau/dt)
//
// h is constant. The biases d_x and d are path-driven: what a node misses of an engine is another miss elsewhere, so it
// forgets as
// the engine moves,  rho = exp(-sqrt((dN1c/l_N)^2 + (dM/l_M)^2)),  P_dd += (1 - rho^2) diag((factor lambda)^2),  and not
// with time. eta = ln N1c - lag(ln N1c, tau = 25 s): the table's metal is in balance, the engine's is not. A sensor
// that is missing is left out; there is no design for that. Health is not opened after a step (a constant is deaf to
// it). Units: x, y, z in percent of the design's trims (scaling.h), h in percent. Source: theory.md, section 14.
// Errors: none after construction. Real-time safe: yes, all but construction.

#include <memory>
#include <vector>

#include "monitor/estimation/estimator.h"
#include "monitor/schedule/point_lookup.h"

namespace ehm::schedule {

struct ScheduledOptions {
  double sample_time_s = 0.015;
  double early_gain_percent = 6.0;   ///< a; at 15 ms
  double speed_walk_percent = 5e-4;  ///< of the states, standard deviation a 15 ms step
  double health_walk_percent = 1e-4;
  double least_n1_corrected_rpm = 0.0;  ///< below, only the states are followed
};

/// What does not change while it flies, shared by all engines of a design.
struct ScheduledModel {
  ScheduledModel(Schedule schedule, const ScheduledOptions& settings)
      : lookup(std::move(schedule)), options(settings) {}

  PointLookup lookup;
  ScheduledOptions options;
  estimation::StateVector state_scale;    ///< one percent, channel units
  estimation::SensorVector sensor_scale;  ///< one percent of trim
  estimation::SensorVector noise, trim;   ///< sigma at trim, channel units
  estimation::SensorVector lag_s;
  estimation::HealthVector health_scale;  ///< one percent, channel units
  estimation::HealthVector health_sigma;  ///< of the fleet, percent
  std::vector<int> sensor_of_state;       ///< that measures it; -1: none
  bool noise_of_reading = true;           ///< sigma grows with the reading
};

class ScheduledEstimator final : public estimation::Estimator {
 public:
  explicit ScheduledEstimator(std::shared_ptr<const ScheduledModel> model);

  [[nodiscard]] std::unique_ptr<Estimator> clone() const override;
  void reset() noexcept override;
  bool use(estimation::SensorMask available) noexcept override;
  void predict(const estimation::Conditions& before, int steps) noexcept override;
  void innovate(const estimation::SensorVector& y, const estimation::Conditions& now) noexcept override;
  void update(estimation::SensorMask fused, std::int64_t hold) noexcept override;
  void widen(double excess) noexcept override;
  void save(estimation::EstimatorState& state) const noexcept override { state = {}; }
  bool restore(const estimation::EstimatorState&) noexcept override { return false; }
  [[nodiscard]] double distance(const estimation::Conditions& conditions) const noexcept override;
  [[nodiscard]] const estimation::Innovation& innovation() const noexcept override { return innovation_; }
  [[nodiscard]] const estimation::Estimate& estimate() const noexcept override { return estimate_; }
  [[nodiscard]] estimation::SensorSpan span() const noexcept override;

 private:
  static constexpr int max_unknowns = 2 * estimation::max_states + estimation::max_health + estimation::max_sensors;
  using UnknownVector = estimation::BoundedVector<max_unknowns>;
  using StateMatrix = estimation::BoundedMatrix<estimation::max_states, estimation::max_states>;
  using UnknownMatrix = estimation::BoundedMatrix<max_unknowns, max_unknowns>;

  Eigen::Index first_bias() const noexcept { return states_ + health_; }
  UnknownVector bias_variance() const noexcept;
  Place place_of(const linear_model::OperatingPoint& flight) const noexcept;
  bool start(const estimation::SensorVector& y, const estimation::Conditions& now) noexcept;
  void follow_path(const Place& place, bool first) noexcept;
  void step(double dt_s) noexcept;
  void predict_readings(bool first) noexcept;
  estimation::StateVector rates() const noexcept;
  UnknownVector slopes(Eigen::Index sensor) const noexcept;
  double reading_sigma(Eigen::Index sensor) const noexcept;
  double noise_of(Eigen::Index sensor) const noexcept;
  void read_out() noexcept;

  std::shared_ptr<const ScheduledModel> model_;
  Eigen::Index states_, health_, sensors_;
  PointModel point_;
  estimation::StateVector x_;  ///< channel units
  estimation::ActuatorVector u_;
  UnknownVector xi_;  ///< [not used; h; d_x; d], percent, d_x a second
  UnknownMatrix p_;
  estimation::SensorVector lagged_;  ///< predicted readings, channel units
  estimation::Innovation innovation_;
  estimation::Estimate estimate_;
  double fleet_trace_, excess_ = 1.0;
  double log_n1_lagged_ = 0.0, eta_ = 0.0;
  double n1_corrected_rpm_ = 0.0, mach_ = 0.0, path_ = 0.0;
  std::int64_t samples_ = 0;
  int lost_ = 0;
  bool begun_ = false, teach_ = false;
};

}  // namespace ehm::schedule
