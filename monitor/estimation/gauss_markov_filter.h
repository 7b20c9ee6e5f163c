// SPDX-License-Identifier: Apache-2.0
#pragma once
// The steady-state Kalman filter on all n + p states, health as a Gauss-Markov process that fades towards the fleet's
// mean (theory.md, section 8):
//
//   model     h[k+1] = rho h[k] + w,  0 < rho < 1,  cov(w) = (1 - rho^2) Ph, so that h has the covariance Ph for ever
//   predict   xpred = A x + B u + L h,  hpred = rho h
//   correct   nu = y - [C M] [xpred; hpred] - D u,   [x; h] = [xpred; hpred] + K nu
//
// K is (n+p) x m, steady, from the Riccati equation (design/gauss_markov_design.h); rho < 1 makes the pair
// detectable although m < p: what no sensor sees returns to the fleet's mean, with the time constant
// -T_sample / ln(rho). Starts at xhat = 0. A sensor that is not fused is bridged by prediction for a few samples; one
// that stays away needs a gain of its own. Deviations from trim, units of the model.

#include <memory>
#include <utility>

#include "monitor/estimation/full_order_model.h"

namespace ehm::estimation {

struct GaussMarkovGain {
  double rho = 0.0;
  BoundedMatrix<max_augmented, max_sensors> K;
  SensorVector innovation_variance;  ///< diag([C M] P [C M]^T + R), P the predicted covariance
};

class GaussMarkovFilter {
 public:
  /// Copies share both.
  /// @throws std::invalid_argument if rho is not between 0 and 1 or a shape does not fit the model.
  GaussMarkovFilter(std::shared_ptr<const FullOrderModel> model, std::shared_ptr<const GaussMarkovGain> gain);
  GaussMarkovFilter(const FullOrderModel& model, const GaussMarkovGain& gain)
      : GaussMarkovFilter(std::make_shared<const FullOrderModel>(model),
                          std::make_shared<const GaussMarkovGain>(gain)) {}

  /// Real-time safe: yes.
  void predict(const ActuatorVector& du_previous) noexcept;
  /// nu of all m sensors; entries of sensors without a value may be NaN, they are then not to be fused. Real-time safe:
  /// yes.
  void innovation(const SensorVector& dy, const ActuatorVector& du) noexcept;
  /// Real-time safe: yes.
  void update(SensorMask fused) noexcept;
  /// Back to the trim engine. Real-time safe: yes.
  void reset() noexcept;
  /// Goes on with the gain of other sensors, of the same shape. Real-time safe: yes.
  void use(const std::shared_ptr<const GaussMarkovGain>& gain) noexcept { gain_ = gain; }

  /// Goes on from a corrected [x; h]. Real-time safe: yes. @returns false, and changes nothing, if its length is another.
  bool restore(const AugmentedVector& estimate) noexcept;

  /// [x; h]
  [[nodiscard]] const AugmentedVector& estimate() const noexcept { return estimate_; }
  [[nodiscard]] const HealthVector& health() const noexcept { return health_; }
  [[nodiscard]] const AuxiliaryVector& auxiliary() const noexcept { return auxiliary_; }
  /// As measured, not masked.
  [[nodiscard]] const SensorVector& innovation() const noexcept { return innovation_; }
  [[nodiscard]] const SensorVector& innovation_variance() const noexcept { return gain_->innovation_variance; }

 private:
  void read_out() noexcept;

  std::shared_ptr<const FullOrderModel> model_;
  std::shared_ptr<const GaussMarkovGain> gain_;
  AugmentedVector estimate_;  ///< [x; h], predicted or corrected
  StateVector state_;         ///< the next x, before it replaces the present one
  SensorVector innovation_;
  ActuatorVector actuators_;
  HealthVector health_;
  AuxiliaryVector auxiliary_;
};

}  // namespace ehm::estimation
