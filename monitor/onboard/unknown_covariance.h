// SPDX-License-Identifier: Apache-2.0
#pragma once
// The covariance P of what the on-board filter estimates (unknowns.h), n x n.
//   predict   P <- Phi P Phi' + Q,  Phi = I but for the speeds' rows  [I 0] + dt F + dt^2/2 F_x F  and  rho I  of the
//             biases; Q: speeds and health walk, biases (1 - rho^2) lambda^2
//   update    one reading a time, in the percent of unknowns.h:  g = P c,  s = c'g + r,
//             P <- P - k g' - g k' + s k k'  (Joseph's form of one reading), k = g/s where everything is taught, and
//             zero but for the speeds where the rest is only held (Schmidt's consider filter)
// Source: Simon, Optimal State Estimation, 5.2 and 9 (sequential update, consider states). Errors: none.
// Real-time safe: yes, all but construction.

#include "monitor/onboard/engine_tangent.h"
#include "monitor/onboard/unknowns.h"

namespace ehm::onboard {

/// How far a step leads.
struct StepSize {
  double dt_s;
  double speed_variance, health_variance;  ///< that it adds, percent^2
  double memory = 1.0;                     ///< rho of the path-driven biases
};

class UnknownCovariance {
 public:
  explicit UnknownCovariance(const UnknownLayout& layout)
      : layout_(layout), p_(UnknownMatrix::Zero(layout.count(), layout.count())) {}

  /// Speeds and biases known, health and causes as well as this says.
  void start(const UnknownMatrix& health_and_causes) noexcept {
    p_.setZero();
    const Eigen::Index n = layout_.health_count + layout_.cause_count;
    p_.block(UnknownLayout::first_health(), UnknownLayout::first_health(), n, n) = health_and_causes;
  }
  void predict(const EngineTangent& tangent, const StepSize& step) noexcept;
  /// Variance of a reading whose slopes are `row`.
  double variance(const UnknownVector& row) const noexcept { return row.dot(p_ * row); }
  /// Takes in one reading with this noise variance; returns by how much of its innovation each unknown moves.
  UnknownVector update(const UnknownVector& row, double noise_variance, bool teach) noexcept;

  double variance_of(Eigen::Index unknown) const noexcept { return p_(unknown, unknown); }
  double health_trace() const noexcept {
    return p_.diagonal().segment(UnknownLayout::first_health(), layout_.health_count).sum();
  }
  /// The unknowns from `first` on vary more by so much, independently.
  void open(Eigen::Index first, const UnknownVector& variance) noexcept {
    p_.diagonal().segment(first, variance.size()) += variance;
  }
  const UnknownMatrix& matrix() const noexcept { return p_; }

 private:
  UnknownLayout layout_;
  UnknownMatrix p_;
};

}  // namespace ehm::onboard
