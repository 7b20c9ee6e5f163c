// SPDX-License-Identifier: Apache-2.0
#pragma once
// Total error of the tuner filter while it converges, so that the published sigma is honest from the first sample on.
//
// What is unknown of an engine but constant: its health h ~ (0, Ph), and what its nonlinearity adds to sensors and
// outputs, [ry; rz] ~ (0, Lambda). Written with k unit-variance unknowns e: h = Gh e, steady sensors H h + ry = Gy e,
// outputs Hz h + rz = Gz e. After a number of samples the filter's estimate has
//   E[xhat | e] = M e,                                   M <- Acl M + K Gy,            M (n+t) x k
//   cov(xhat - [dx; 0]) = S,   S <- Acl S Acl^T + K R K^T + (I - K C) Qw (I - K C)^T,   S (n+t) x (n+t)
// with Acl = (I - K C) A, dx the engine's own motion about its balance, dx[k+1] = A dx[k] + w, cov(w) = Q, and
// Qw = blkdiag(Q, 0). The published standard deviations are the roots of the diagonals of
//   (Th M - Gh)(..)^T + Th S Th^T    and    (Tz M - Gz)(..)^T + Tz S Tz^T.
// For an engine far outside the fleet the parts that were measured over the fleet grow (diagnosis/fleet_watch.h): with
// the excess e the columns of M - G of the health by e^1/2, those of the nonlinearity, which grows with the square of
// the health, by e. e = 1 within the fleet.
// M_0 = 0 and S_0 = blkdiag(cov(dx), 0) for a cold start, with the stationary cov(dx) = A cov(dx) A^T + Q: the engine
// has run before the monitor looks at it, and the first sigma is the prior's. The limit k -> infinity is that of
// theory.md, section 4.
// The innovation of the next sample then has the variance
//   diag[(C A M - Gy)(..)^T + C A S (C A)^T + C Qw C^T + R],
// far above the settled one at a cold start: the innovation gate asks for it, so as not to reject a worn engine.
// When another sensor set takes over, M and S are re-referenced as the state is, and go on from there.
// Everything is in the scaled units of the design; sigmas leave in channel units.

#include <vector>

#include "monitor/estimation/capacity.h"
#include "monitor/estimation/kept_matrix.h"

namespace ehm::estimation {

/// Constants of one sensor set; scaled units except for the two scales.
struct ErrorModel {
  BoundedMatrix<max_augmented, max_augmented> closed_loop;       ///< Acl
  BoundedMatrix<max_augmented, max_unknowns> drive;              ///< K Gy
  BoundedMatrix<max_augmented, max_augmented> noise;             ///< K R K^T + (I - K C) Qw (I - K C)^T
  BoundedMatrix<max_augmented, max_augmented> start;             ///< S_0
  BoundedMatrix<max_health, max_augmented> health_output;        ///< Th
  BoundedMatrix<max_auxiliary, max_augmented> auxiliary_output;  ///< Tz
  BoundedMatrix<max_sensors, max_augmented> prediction;          ///< C A, every sensor
  BoundedMatrix<max_health, max_unknowns> health_truth;          ///< Gh
  BoundedMatrix<max_auxiliary, max_unknowns> auxiliary_truth;    ///< Gz
  BoundedMatrix<max_sensors, max_unknowns> sensor_truth;         ///< Gy, every sensor
  SensorVector innovation_noise;                                 ///< diagonal of C Qw C^T + R
  HealthVector health_scale;                                     ///< channel units per scaled unit
  AuxiliaryVector auxiliary_scale;
  SensorVector sensor_scale;
  int settling_samples = 0;  ///< seven of the slowest time constants: 0.1 % is left
};

/// What the error has become so far, for a checkpoint.
struct ErrorState {
  BoundedMatrix<max_augmented, max_unknowns> mean;         ///< M
  BoundedMatrix<max_augmented, max_augmented> covariance;  ///< S
  int remaining = 0;                                       ///< samples until it counts as settled
};

/// It has the shapes of that sensor set, and is not longer from settled than a cold start. Real-time safe: yes.
bool fits(const ErrorState& state, const ErrorModel& model) noexcept;

/// What makes up the variance of each output of one kind, scaled units: of the fleet's health, of its nonlinearity, and
/// of the noise.
template <int Max>
struct VarianceParts {
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Max, 1>;
  Vector prior, nonlinear, noise;

  /// Standard deviations in channel units of an engine with this excess. Real-time safe: yes.
  Vector sigma(double excess, const Vector& scale) const noexcept {
    return scale.cwiseProduct((noise + excess * prior + excess * excess * nonlinear).cwiseSqrt());
  }
};

class ErrorPropagation {
 public:
  /// `model` must outlive this. Starts cold.
  explicit ErrorPropagation(const ErrorModel& model) : ErrorPropagation(model, model.closed_loop.rows()) {}
  /// With room for sensor sets of up to `most_states` n + t; the unknowns are the same in all of them.
  ErrorPropagation(const ErrorModel& model, Eigen::Index most_states);

  /// Cold start. Real-time safe: yes.
  void reset(const ErrorModel& model) noexcept;
  /// Goes on with another sensor set; `transfer` is what the filter's state was multiplied with, nothing if that means
  /// the same for both. Real-time safe: yes, both.
  void switch_to(const ErrorModel& model, const BoundedMatrix<max_augmented, max_augmented>& transfer) noexcept;
  void switch_to(const ErrorModel& model) noexcept;
  /// Real-time safe: yes, both. `state` must have the shapes of `model`.
  void save(ErrorState& state) const noexcept;
  void restore(const ErrorModel& model, const ErrorState& state) noexcept;
  /// One sample further; costs nothing once settled. Real-time safe: yes.
  void step() noexcept;

  /// The sigmas are those of an engine with this excess, 1 or more, from now on. Real-time safe: yes.
  void widen(double excess) noexcept {
    if (excess == excess_) return;
    excess_ = excess;
    publish();
  }

  bool settled() const noexcept { return remaining_ <= 0; }
  const HealthVector& health_sigma() const noexcept { return health_sigma_; }
  const AuxiliaryVector& auxiliary_sigma() const noexcept { return auxiliary_sigma_; }
  /// Of the whole error of health, channel units squared; health_sigma squared is its diagonal. Real-time safe: yes.
  HealthCovariance health_covariance() const noexcept;
  const VarianceParts<max_health>& health_variance() const noexcept { return health_parts_; }
  const VarianceParts<max_auxiliary>& auxiliary_variance() const noexcept { return auxiliary_parts_; }
  /// Of the innovations of the next sample, sensor units squared.
  const SensorVector& innovation_variance() const noexcept { return innovation_variance_; }

 private:
  using Mean = BoundedMatrix<max_augmented, max_unknowns>;
  using Covariance = BoundedMatrix<max_augmented, max_augmented>;
  void keep(const Mean& mean, const Covariance& covariance) noexcept;
  void read_out(const Mean& mean, const Covariance& covariance) noexcept;
  void publish() noexcept;

  const ErrorModel* model_;
  KeptMatrix<max_augmented, max_unknowns> mean_;         ///< M
  KeptMatrix<max_augmented, max_augmented> covariance_;  ///< S
  VarianceParts<max_health> health_parts_;
  VarianceParts<max_auxiliary> auxiliary_parts_;
  double excess_ = 1.0;
  HealthVector health_sigma_;
  AuxiliaryVector auxiliary_sigma_;
  SensorVector innovation_variance_;
  int remaining_ = 0;
};

}  // namespace ehm::estimation
