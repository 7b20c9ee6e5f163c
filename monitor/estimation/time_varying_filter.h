// SPDX-License-Identifier: Apache-2.0
#pragma once
// The time-varying Kalman filter on all n + p states, h constant: no linear estimator knows more after the same samples
// (theory.md, section 8): it is the limit for N samples.
//
//   start     xhat = 0, P = [X; I] Ph [X; I]^T: a settled engine of the fleet, X = (I-A)^-1 L. The state is then as
//             uncertain as the health that moved it, and fully correlated with it: the first sample gives full MAP.
//   predict   x <- A x + B u + L h     Pxx <- A Pxx A^T + T L^T + L (A Pxh)^T + Q,  T = A Pxh + L Phh;  Pxh <- T
//   update    for each fused sensor i, c = [C_i M_i]:   s = c P c^T + r_i,  b = P c^T / sqrt(s)
//             xhat <- xhat + b (y_i - D_i u - c xhat) / sqrt(s),   P <- P - b b^T
//
// One sensor after the other, which is exact because R is diagonal: no inverse, P symmetric to the last bit, and what
// is not fused is just left out, sample by sample. Health never forgets: the gain goes to zero as 1/k, so a later
// change of health is followed ever more slowly (gauss_markov_filter.h forgets). On the linear model covariance() is
// the error's own, over the fleet: bias included. Deviations from trim, units of the model. Source: Bierman,
// Factorization Methods for Discrete Sequential Estimation (1977), ch. II, scalar measurement processing.
//
// The real engine adds constant offsets that this model leaves out, Ey e to the sensors and Ez e to the outputs, e of
// unit variance (full_order_model.h). They are considered, not estimated: D = E[xhat - [x; h] | e] is carried along,
//   D <- [A L; 0 I] D,    D <- D + b (Ey_i - c D) / sqrt(s)
// and adds diag(Dh Dh^T) and diag((Tz D - Ez) (..)^T) to the variances. Source: Schmidt's consider filter; Bierman,
// ch. VIII.

#include <memory>

#include "monitor/estimation/full_order_model.h"

namespace ehm::estimation {

class TimeVaryingFilter {
 public:
  /// Copies share the model.
  explicit TimeVaryingFilter(std::shared_ptr<const FullOrderModel> model);
  explicit TimeVaryingFilter(const FullOrderModel& model)
      : TimeVaryingFilter(std::make_shared<const FullOrderModel>(model)) {}

  /// One sample further; not before the first one. Real-time safe: yes.
  void predict(const ActuatorVector& du_previous) noexcept;
  /// nu of all m sensors and its variance; entries of sensors without a value may be NaN, they are then not to be
  /// fused. Real-time safe: yes.
  void innovation(const SensorVector& dy, const ActuatorVector& du) noexcept;
  /// Real-time safe: yes.
  void update(SensorMask fused) noexcept;
  /// Back to the settled engine of the fleet. Real-time safe: yes.
  void reset() noexcept;

  /// Goes on from an estimate with its P and D. Real-time safe: yes. @returns false, and changes nothing, if their
  /// shapes are not the model's.
  bool restore(const AugmentedVector& estimate, const FullOrderCovariance& covariance,
               const BoundedMatrix<max_augmented, max_unknowns>& offset) noexcept;

  /// [x; h]
  [[nodiscard]] const AugmentedVector& estimate() const noexcept { return estimate_; }
  [[nodiscard]] const HealthVector& health() const noexcept { return health_; }
  [[nodiscard]] const AuxiliaryVector& auxiliary() const noexcept { return auxiliary_; }
  /// P, n + p, after the latest predict or update.
  [[nodiscard]] const FullOrderCovariance& covariance() const noexcept { return covariance_; }
  /// D
  [[nodiscard]] const BoundedMatrix<max_augmented, max_offsets>& offset() const noexcept { return offset_; }
  /// diag(Phh) and diag([F N] P [F N]^T). Real-time safe: yes.
  [[nodiscard]] HealthVector health_variance() const noexcept;
  [[nodiscard]] AuxiliaryVector auxiliary_variance() const noexcept;
  /// What the engine's nonlinearity adds to them; 0 where the model knows of none. Real-time safe: yes.
  [[nodiscard]] HealthVector health_offset_variance() const noexcept;
  [[nodiscard]] AuxiliaryVector auxiliary_offset_variance() const noexcept;
  /// Of the predicted sensors, as measured; not masked.
  [[nodiscard]] const SensorVector& innovation() const noexcept { return innovation_; }
  [[nodiscard]] const SensorVector& innovation_variance() const noexcept { return innovation_variance_; }

 private:
  void fuse(Eigen::Index sensor) noexcept;
  void project(Eigen::Index sensor) noexcept;
  void read_out() noexcept;

  std::shared_ptr<const FullOrderModel> model_;
  BoundedMatrix<max_augmented, max_sensors> outputs_;  ///< [C M]^T: a column for each sensor
  AugmentedVector estimate_, gain_;                    ///< [x; h], b
  FullOrderCovariance covariance_;                     ///< P
  BoundedMatrix<max_augmented, max_offsets> offset_;   ///< D
  SensorVector measured_;                              ///< y - D u
  SensorVector innovation_, innovation_variance_;
  ActuatorVector actuators_;
  HealthVector health_;
  AuxiliaryVector auxiliary_;
};

}  // namespace ehm::estimation
