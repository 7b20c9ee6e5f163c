// SPDX-License-Identifier: Apache-2.0
#pragma once
// The on-board engine as a state space: x = [N1 N2; h], speeds in percent of the design point's, health in percent,
// n = 2 + p.
//   f(x) = [N + dt N' + dt^2/2 J N'; h],   N'(x, u): the spools' rates, J = dN'/dN at the reference
//   g(x): the sensors of the engine file, channel units        z(x): its auxiliary outputs
//   F = [I + dt J (I + dt/2 J) ...; 0 I],  H, Z: exact, by dual numbers (gas_path_jacobian.h)
// The metal's temperatures are no states: they follow the reference, the estimate itself, since they are stable and
// slow, and what they are off by is not of the filter's knowledge. For balance_s after a cold start they are in balance
// with the gas: an engine that was at rest, of which the health is still being found, would else carry the heat of
// another one for minutes (measured: coverage of health .79 in place of .92 after 30 s). The reference also is where Z
// holds, and from where the engine's own solution is continued; refer() moves it, and so does every question with slopes.
// Errors: false where the engine has no answer (state_space.h). Real-time safe: yes, after construction.

#include <array>
#include <memory>

#include "engine_sim/model/onboard/on_board_engine.h"
#include "monitor/estimation/estimator.h"
#include "monitor/nonlinear/state_space.h"
#include "monitor/onboard/engine_channels.h"
#include "monitor/onboard/engine_motion.h"

namespace ehm::nonlinear {

using OutputSlopes = estimation::BoundedMatrix<estimation::max_auxiliary, max_order>;

inline constexpr double balance_s = 10.0;

class EngineStateSpace final : public StateSpace {
 public:
  /// Without the metal the gas path is in balance at once, as an engine that is flown without heat soak.
  enum class Metal { without, with };
  EngineStateSpace(std::shared_ptr<const onboard::OnBoardModel> model, Metal metal);

  [[nodiscard]] Eigen::Index order() const noexcept override { return order_; }
  [[nodiscard]] Eigen::Index sensor_count() const noexcept override { return sensor_count_; }
  bool respond(const OrderVector& x, Response& response) noexcept override;
  bool respond(const OrderVector& x, Response& response, Slopes& slopes) noexcept override;

  /// What acts on the engine from now on.
  void set(const estimation::Conditions& now) noexcept;
  /// A start: the spools turn as measured (start_motion.h), the metal is in balance unless it is kept. `x` comes with
  /// its health and gets its speeds.
  bool start(const std::array<double, onboard::speed_count>& measured_rpm, bool keep_metal, OrderVector& x) noexcept;
  /// Moves the reference there; the slopes are made anew where they are due.
  bool refer(const OrderVector& x) noexcept;
  /// The metal goes on for one step from the reference.
  void advance_metal() noexcept;

  /// Auxiliary outputs at x by the tangent at the reference, and Z.
  estimation::AuxiliaryVector outputs(const OrderVector& x) const noexcept;
  const OutputSlopes& output_slopes() const noexcept { return output_slopes_; }
  /// N1/sqrt(theta2), rpm, at the reference.
  double n1_corrected_rpm() const noexcept { return n1_corrected_rpm_; }

 private:
  engine_sim::Operation operation_at(const OrderVector& x) const noexcept;
  engine_sim::SpoolSpeeds speeds_at(const OrderVector& x) const noexcept;
  const engine_sim::MetalTemperatures* metal() const noexcept {
    return with_metal_ && balance_left_s_ <= 0.0 ? &metal_k_ : nullptr;
  }
  void tell(const engine_sim::GasPath& gas, const OrderVector& x, Response& response) const noexcept;
  void take_reference(const OrderVector& x, const engine_sim::GasPath& gas) noexcept;
  bool due(const OrderVector& x) const noexcept;

  std::shared_ptr<const onboard::OnBoardModel> model_;
  onboard::EngineChannels channels_;
  Eigen::Index order_, sensor_count_;
  bool with_metal_;
  engine_sim::OnBoardEngine engine_;
  engine_sim::Operation operation_;  ///< without health
  engine_sim::MetalTemperatures metal_k_{}, metal_rates_k_s_{};
  Eigen::Matrix2d speed_rates_ = Eigen::Matrix2d::Zero();  ///< J, 1/s
  OutputSlopes output_slopes_;
  OrderVector reference_, renewed_at_;
  estimation::AuxiliaryVector reference_outputs_;
  double n1_corrected_rpm_ = 0.0;
  double balance_left_s_ = 0.0;
  int age_samples_ = -1;  ///< of the slopes; -1: there are none
};

}  // namespace ehm::nonlinear
