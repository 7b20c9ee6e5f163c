// SPDX-License-Identifier: Apache-2.0
#pragma once
// A nonlinear filter on the on-board engine as an Estimator: spools and health as states (engine_state_space.h), no
// causes of mismatch, no biases. What the truth differs by from the engine file it takes for health: the filters of the
// papers, as they are; onboard/on_board_estimator.h is the one that knows of mismatch.
//
//   Q  = (walk of speeds and health, a step)^2             z = z(x),  sigma_z^2 = Z P Z'
//   R  = sigma_i^2 + (a tr Ph/tr Ph(fleet) y_i/100)^2      a: early gain
//
// A lagged sensor is predicted lagged. Below least_n1 only the speeds are fused. The first sample starts the spools as
// measured and the health at the prior. Where the engine has no answer the estimate does not hold; after a second of
// that, it starts cold. Source: theory.md, section 18. Errors: none after construction. Real-time safe: yes, all but
// construction and clone().

#include <memory>

#include "monitor/estimation/estimator.h"
#include "monitor/nonlinear/engine_state_space.h"
#include "monitor/nonlinear/nonlinear_filter.h"

namespace ehm::nonlinear {

/// What the filter asks of the engine by itself.
enum class Reference {
  by_filter,    ///< slopes at every estimate: they are the reference
  by_estimator  ///< values only: the estimator moves the reference
};

struct NonlinearTraits {
  Reference reference = Reference::by_filter;
  double early_gain_percent = 0.0;  ///< a, at 15 ms
};

/// diag Q of a step of that model.
FilterNoise engine_noise(const onboard::OnBoardModel& model);

class NonlinearEstimator final : public estimation::Estimator {
 public:
  /// `model` without causes of mismatch.
  NonlinearEstimator(std::shared_ptr<const onboard::OnBoardModel> model, std::unique_ptr<NonlinearFilter> filter,
                     NonlinearTraits traits);

  [[nodiscard]] std::unique_ptr<Estimator> clone() const override;
  void reset() noexcept override;
  bool use(estimation::SensorMask available) noexcept override;
  void predict(const estimation::Conditions& before, int steps) noexcept override;
  void innovate(const estimation::SensorVector& y, const estimation::Conditions& now) noexcept override;
  void update(estimation::SensorMask fused, std::int64_t hold) noexcept override;
  void widen(double excess) noexcept override;
  void save(estimation::EstimatorState& state) const noexcept override;
  bool restore(const estimation::EstimatorState& state) noexcept override;
  [[nodiscard]] estimation::Learned learned() const noexcept override;
  bool begin_with(const estimation::Learned& known, double wear_percent) noexcept override;
  void next_flight(double wear_percent) noexcept override;
  [[nodiscard]] estimation::HealthCovariance health_covariance() const noexcept override;
  [[nodiscard]] estimation::SensorSpan span() const noexcept override { return model_->span(); }
  [[nodiscard]] double distance(const estimation::Conditions& conditions) const noexcept override;
  [[nodiscard]] const estimation::Innovation& innovation() const noexcept override { return innovation_; }
  [[nodiscard]] const estimation::Estimate& estimate() const noexcept override { return estimate_; }

 private:
  void start_cold() noexcept;
  bool start(const estimation::SensorVector& y) noexcept;
  bool foresee() noexcept;
  void lose() noexcept;
  void read_out() noexcept;
  Eigen::Index health_count() const noexcept { return space_.order() - onboard::speed_count; }

  std::shared_ptr<const onboard::OnBoardModel> model_;
  EngineStateSpace space_;
  std::unique_ptr<NonlinearFilter> filter_;
  NonlinearTraits traits_;
  estimation::Learned prior_;
  double fleet_trace_;
  SensorVector lagged_, own_noise_;
  estimation::Innovation innovation_;
  estimation::Estimate estimate_;
  double excess_ = 1.0;
  std::int64_t samples_ = 0, lost_ = 0;
  bool begun_ = false, metal_known_ = false, first_ = true, teach_ = false;
};

}  // namespace ehm::nonlinear
