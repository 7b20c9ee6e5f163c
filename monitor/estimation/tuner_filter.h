// SPDX-License-Identifier: Apache-2.0
#pragma once
// The steady-state Kalman filter on the tuners, which flies ([SG] eqs. 15-17, with the actuators kept):
//
//   xpred = Axq xhat[k-1] + Bxq u[k-1]
//   nu    = y[k] - Cxq xpred - D u[k]
//   xhat  = xpred + K nu                      nu_i = 0 for a sensor that is not fused: it is bridged by prediction
//   h     = h_trim + Th xhat                  z = z_trim + Tz xhat + G u[k]
//
// xhat = [x; q], n + t. y and u are deviations from trim in channel units, and so are nu, h and z; x and q are scaled
// inside. q is constant from sample to sample: Axq = [A, L W; 0, I], Bxq = [B; 0]. A sensor that stays away gets
// another design (switch_sensor_set): zeroing its gain for good would leave an eigenvalue of exactly 1. Deterministic;
// no clock, allocation, lock or exception after construction.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/capacity.h"
#include "monitor/estimation/linear/padded_matrix.h"

namespace ehm::estimation {

/// A set of sensors for which a design exists: all of them, or all but one.
class SensorSet {
 public:
  static constexpr SensorSet full() noexcept { return SensorSet(-1); }
  static constexpr SensorSet without(int sensor) noexcept { return SensorSet(sensor); }
  [[nodiscard]] constexpr bool is_full() const noexcept { return missing_ < 0; }
  /// Index of the missing sensor, -1 for the full set.
  [[nodiscard]] constexpr int missing() const noexcept { return missing_; }
  friend constexpr bool operator==(SensorSet, SensorSet) = default;

 private:
  constexpr explicit SensorSet(int missing) noexcept : missing_(missing) {}
  int missing_;
};

/// The filter of one sensor set. Rows and columns of sensors are always those of the whole model.
struct SubsetGain {
  SensorMask sensors;                                              ///< used by this design
  BoundedMatrix<max_augmented, max_augmented> A;                   ///< Axq
  BoundedMatrix<max_augmented, max_actuators> B;                   ///< Bxq, per actuator unit
  BoundedMatrix<max_sensors, max_augmented> C;                     ///< Cxq, sensor units, all m rows
  BoundedMatrix<max_augmented, max_sensors> K;                     ///< per sensor unit; zero columns where not used
  BoundedMatrix<max_health, max_augmented> health_output;          ///< Th = [0, Rh], health units
  BoundedMatrix<max_auxiliary, max_augmented> auxiliary_output;    ///< Tz = [F, Rz], auxiliary units
  BoundedMatrix<max_augmented, max_augmented> from_full, to_full;  ///< re-reference the state at a switch
  SensorVector innovation_variance;                                ///< see TunerFilter::innovation_variance
  HealthVector health_sigma_total, health_sigma_filter;
  AuxiliaryVector auxiliary_sigma_total, auxiliary_sigma_filter;
  BoundedMatrix<max_health, max_health> health_noise_covariance;  ///< Th S Th^T: what one engine's estimate scatters
  BoundedMatrix<max_auxiliary, max_auxiliary> auxiliary_noise_covariance;  ///< Tz S Tz^T
};

/// Everything that a TunerFilter needs, in channel units. Made from a design by design::make_filter.
struct TunerFilterModel {
  BoundedMatrix<max_sensors, max_actuators> D;
  BoundedMatrix<max_auxiliary, max_actuators> G;
  HealthVector health_trim;
  AuxiliaryVector auxiliary_trim;
  int states = 0;
  SubsetGain full;
  std::vector<std::optional<SubsetGain>> missing;  ///< [i] without sensor i; empty where that is not observable
};

class TunerFilter {
 public:
  /// Copies share the matrices.
  /// @throws std::invalid_argument if the matrices do not fit together (names the matrix and both shapes).
  explicit TunerFilter(TunerFilterModel model);

  /// xpred from the actuators that acted at the previous sample. Real-time safe: yes.
  void predict(const ActuatorVector& du_previous) noexcept;
  /// nu of all m sensors; entries of sensors without a value may be NaN, they are then not to be fused. Real-time safe:
  /// yes.
  void innovation(const SensorVector& dy, const ActuatorVector& du) noexcept;
  /// xhat, h and z from the sensors that are both fused and in the present set. Real-time safe: yes.
  void update(SensorMask fused) noexcept;
  /// Changes the design. x and q are re-referenced through q_S = (H_S W_S)^+ H_S W q and the matching steady shift of
  /// x, so that the predicted sensors of the new set, now and later, do not notice. Real-time safe: yes.
  /// @returns false, and changes nothing, if there is no design for that set.
  bool switch_sensor_set(SensorSet set) noexcept;
  /// Lets health and auxiliary go on from these values after a change of the sensor set: what the other set knew of the
  /// directions that this one does not see. Of it `fading` is lost with each sample, since wear may move, and all with
  /// the next change. Real-time safe: yes.
  void carry(const HealthVector& health, const AuxiliaryVector& auxiliary, double fading) noexcept;
  /// Adds `delta` to xhat: takes out what a fault has put in. Real-time safe: yes.
  void shift(const AugmentedVector& delta) noexcept;
  /// Goes on from an estimate that this filter had before: `estimate` is [x; q] of the design for `set`. Real-time
  /// safe: yes. @returns false, and changes nothing, if there is no such design or the length is not its.
  bool restore(SensorSet set, const AugmentedVector& estimate) noexcept;
  /// Back to xhat = 0 (the trim engine) with the full sensor set. Real-time safe: yes.
  void reset() noexcept;

  [[nodiscard]] bool available(SensorSet set) const noexcept;
  [[nodiscard]] SensorSet sensor_set() const noexcept { return set_; }
  /// Sensors that the present design uses.
  [[nodiscard]] SensorMask sensors() const noexcept { return gain().sensors; }

  /// Deviation + trim, in channel units.
  [[nodiscard]] const HealthVector& health() const noexcept { return health_; }
  [[nodiscard]] const AuxiliaryVector& auxiliary() const noexcept { return auxiliary_; }
  /// xhat = [x; q] of the present design, scaled.
  [[nodiscard]] const AugmentedVector& estimate() const noexcept { return updated_; }
  /// q, in percent of health.
  [[nodiscard]] TunerVector tuners() const noexcept {
    return updated_.segment(model().states, gain().A.rows() - model().states);
  }

  /// Total error over the fleet (bias and noise, theory.md, section 4): the published standard deviation.
  [[nodiscard]] const HealthVector& health_sigma_total() const noexcept { return gain().health_sigma_total; }
  [[nodiscard]] const AuxiliaryVector& auxiliary_sigma_total() const noexcept { return gain().auxiliary_sigma_total; }
  /// The filter's own, blind to the directions that the tuners do not span.
  [[nodiscard]] const HealthVector& health_sigma_filter() const noexcept { return gain().health_sigma_filter; }
  [[nodiscard]] const AuxiliaryVector& auxiliary_sigma_filter() const noexcept { return gain().auxiliary_sigma_filter; }

  /// nu as measured, sensor units; not masked.
  [[nodiscard]] const SensorVector& innovation() const noexcept { return innovation_; }
  /// Used sensors: diag(C P C^T + R). Others: the fleet's bias variance on top, since nothing corrects them.
  [[nodiscard]] const SensorVector& innovation_variance() const noexcept { return gain().innovation_variance; }

  /// Present design, for what compares estimates over time (shift detection).
  [[nodiscard]] const SubsetGain& gain() const noexcept {
    return set_.is_full() ? model().full : *model().missing[as_size(set_.missing())];
  }
  [[nodiscard]] const TunerFilterModel& model() const noexcept { return constants_->model; }

 private:
  /// The matrices of one sensor set as a step uses them.
  struct Step {
    PaddedMatrix state_prediction;   ///< [Axq, Bxq] on [xhat; u]
    PaddedMatrix sensor_prediction;  ///< -Cxq [Axq, Bxq]
    PaddedMatrix correction;         ///< K on nu
    PaddedMatrix health;             ///< W on q
    PaddedMatrix auxiliary;          ///< [Tz, G] on [xhat; u]
  };

  /// Shared by all copies of a filter.
  struct Constants {
    TunerFilterModel model;
    PaddedMatrix minus_D;
    alignas(32) HealthVector health_trim;  ///< the model's with zeros behind, as far as a product reads
    alignas(32) AuxiliaryVector auxiliary_trim;
    Step full_step;
    std::vector<Step> missing_step;  ///< as model.missing
  };

  static Step step_of(const SubsetGain& gain, const TunerFilterModel& model);
  static Constants constants_of(TunerFilterModel model);
  const Step& step() const noexcept {
    return set_.is_full() ? constants_->full_step : constants_->missing_step[as_size(set_.missing())];
  }
  void re_reference(const BoundedMatrix<max_augmented, max_augmented>& transfer) noexcept;
  void read_out() noexcept;
  void drop_carried() noexcept;

  std::shared_ptr<const Constants> constants_;
  SensorSet set_ = SensorSet::full();
  alignas(32) AugmentedVector updated_;     ///< xhat
  alignas(32) AugmentedVector predicted_;   ///< xpred
  alignas(32) SensorVector minus_sensors_;  ///< -Cxq xpred
  alignas(32) SensorVector innovation_;
  ActuatorVector du_;  ///< of the latest sample
  SensorVector fused_innovation_;
  alignas(32) HealthVector health_;
  alignas(32) AuxiliaryVector auxiliary_;
  HealthVector carried_health_;
  AuxiliaryVector carried_auxiliary_;
  double carried_share_ = 0.0, fading_ = 0.0;  ///< of what was carried; 0: nothing
};

}  // namespace ehm::estimation
