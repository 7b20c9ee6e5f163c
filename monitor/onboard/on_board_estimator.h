// SPDX-License-Identifier: Apache-2.0
#pragma once
// The hybrid extended Kalman filter: the nonlinear engine runs beside the real one, from taxi to taxi, and what its
// readings miss teaches health, the causes of mismatch, and a bias of each sensor.
//
//   x- = x + dt f + dt^2/2 F f       f(x, u, h, c): the spools' rates, u held; metal: Euler
//   y^ = y(x, u, h) (1 + (Y_c c + d)/100), lagged like its sensor       xi: unknowns.h, P: unknown_covariance.h
//   r  = sigma^2 + (a tr Ph/tr Ph(fleet))^2 + (s_i^2 + m_i^2) (1 + 2 tau/dt)   in percent^2
//   z  = z(x, u, h) + Z dxi,   sigma_z^2 = Z P Z' + lambda_z^2 + s_z^2 + m_z^2
//
// a: early_gain_percent. s: what the metal's heat does to a reading (or output), by soak_error: the model of the soak
// may be wrong by that share, for as long as the metal takes (tau). m: what 50 K do, by which a start may have put the
// metal wrong; it fades with tau. A start in flight, after the model had no answer, keeps the metal. The bias d is
// path-driven: it forgets as the engine moves,  rho = exp(-sqrt((dN1c/l_N)^2 + (dM/l_M)^2)),  and not with time.
// Where a step of health is found (step_watch.h), P opens by  p_j Ph_jj  and  p_i step_bias_percent^2: constants are
// learned anew, each as far as it may have been the one. Below least_n1 the readings say little of health: only the
// speeds are followed. A sensor that is missing is left out; there is no design for that. Where the engine model has no
// answer for a second, the filter starts cold. Source: theory.md, section 13. Errors: none after construction.
// Real-time safe: yes, all but construction.

#include <memory>

#include "monitor/estimation/estimator.h"
#include "monitor/onboard/engine_tangent.h"
#include "monitor/onboard/learned.h"
#include "monitor/onboard/step_watch.h"
#include "monitor/onboard/unknown_covariance.h"

namespace ehm::onboard {

class OnBoardEstimator final : public estimation::Estimator {
 public:
  explicit OnBoardEstimator(std::shared_ptr<const OnBoardModel> model);

  [[nodiscard]] std::unique_ptr<Estimator> clone() const override;
  void reset() noexcept override;
  bool use(estimation::SensorMask available) noexcept override;
  void predict(const estimation::Conditions& before, int steps) noexcept override;
  void innovate(const estimation::SensorVector& y, const estimation::Conditions& now) noexcept override;
  void update(estimation::SensorMask fused, std::int64_t hold) noexcept override;
  void widen(double excess) noexcept override;
  void save(estimation::EstimatorState& state) const noexcept override;
  bool restore(const estimation::EstimatorState& state) noexcept override;
  [[nodiscard]] estimation::HealthCovariance health_covariance() const noexcept override;
  /// What is unknown besides moves by P_uh Phh^-1 dh.
  bool correct_health(const estimation::HealthVector& health) noexcept override;
  [[nodiscard]] estimation::SensorSpan span() const noexcept override { return model_->span(); }
  [[nodiscard]] double distance(const estimation::Conditions& conditions) const noexcept override;
  [[nodiscard]] const estimation::Innovation& innovation() const noexcept override { return innovation_; }
  [[nodiscard]] const estimation::Estimate& estimate() const noexcept override { return estimate_; }
  [[nodiscard]] Learned learned() const noexcept override;
  bool begin_with(const Learned& known, double wear_percent) noexcept override;
  void next_flight(double wear_percent) noexcept override;
  /// How often it has found that something stepped, since it was made.
  std::int64_t steps_found() const noexcept { return steps_found_; }

 private:
  engine_sim::Operation operation_of(const estimation::Conditions& now) const noexcept;
  bool start(const estimation::SensorVector& y, const engine_sim::Operation& operation) noexcept;
  void step(double dt_s) noexcept;
  void start_cold() noexcept;
  void lose() noexcept;
  void follow_path(const engine_sim::Operation& operation, bool first) noexcept;
  void predict_readings(bool first) noexcept;
  void weigh_readings() noexcept;
  void watch_for_steps(estimation::SensorMask fused) noexcept;
  void forget_findings() noexcept;
  void open_for_step() noexcept;
  void move_by(const UnknownVector& change) noexcept;
  void shift_unknowns(const UnknownVector& change) noexcept;
  /// The causes of mismatch, in their standard deviations.
  UnknownVector causes() const noexcept { return xi_.segment(layout_.first_cause(), layout_.cause_count); }
  UnknownVector linear_causes() const noexcept;
  void set_metal() noexcept;
  void read_out(const UnknownVector& change) noexcept;

  std::shared_ptr<const OnBoardModel> model_;
  UnknownLayout layout_;
  EngineTangent tangent_;
  Learned prior_;  ///< what it starts from
  UnknownCovariance covariance_;
  StepWatch steps_;
  EngineMotion motion_;
  UnknownVector xi_;                         ///< the speeds' places are not used: motion_ has them
  UnknownVector moved_;                      ///< by how much, since the engine answered
  Eigen::Vector2d rates_{0.0, 0.0};          ///< percent/s, at the estimate
  estimation::SensorVector lagged_, noise_;  ///< predicted readings; variances r, percent^2
  ReadingDoubt doubt_;                       ///< what r is made of
  estimation::SensorVector size_;            ///< one percent of each predicted reading, channel units
  estimation::Innovation innovation_;
  estimation::Estimate estimate_;
  bool metal_known_ = false;    ///< there was an answer before the last reset
  double metal_doubt_k_ = 0.0;  ///< of the metal's temperatures since the start, fading
  double fleet_trace_, excess_ = 1.0;
  std::int64_t samples_ = 0, since_step_ = 0, steps_found_ = 0;
  double n1_corrected_rpm_ = 0.0, mach_ = 0.0;  ///< where the path has got to
  double path_ = 0.0;                           ///< that the next prediction forgets by
  int lost_ = 0;                                ///< samples without an answer of the engine, in a row
  bool begun_ = false, teach_ = false;
};

}  // namespace ehm::onboard
