// SPDX-License-Identifier: Apache-2.0
#include "monitor/onboard/start_motion.h"

#include <algorithm>
#include <cmath>

#include "engine_sim/model/parts/root_theta.h"

namespace ehm::onboard {
namespace {

namespace sim = engine_sim;

constexpr double core_at_rest = 0.6;  ///< of its design speed, where the fan stands still
constexpr double slowest = 0.2, fastest = 1.1;

/// Speeds as shares of the design point's at the same corrected speed.
std::array<double, speed_count> shares(const OnBoardModel& model, const sim::Operation& operation, double root_theta,
                                       const std::array<double, speed_count>& measured_rpm) {
  const sim::DesignPoint& design = model.engine().data().design;
  const sim::Intake at_design = sim::intake(model.engine().data().inlet, design.flight);
  const double root_design = sim::root_theta(model.engine().data().inlet, design.flight);
  const double n1 = measured_rpm[0] / design.speeds.n1_rpm * root_design / root_theta;
  const double n2 = measured_rpm[1] / design.speeds.n2_rpm * root_design / root_theta;
  if (std::isfinite(n1) && std::isfinite(n2)) return {n1, n2};
  if (std::isfinite(n1)) return {n1, core_at_rest + (1.0 - core_at_rest) * n1};
  if (std::isfinite(n2)) return {std::clamp((n2 - core_at_rest) / (1.0 - core_at_rest), slowest, fastest), n2};
  const sim::Intake now = sim::intake(model.engine().data().inlet, operation.flight);
  const double corrected_fuel = operation.fuel_flow_kg_s / design.fuel_flow_kg_s * at_design.fan_face_pt_pa /
                                now.fan_face_pt_pa * root_design / root_theta;
  const double share = std::clamp(std::pow(corrected_fuel, 0.4), slowest, fastest);
  return {share, core_at_rest + (1.0 - core_at_rest) * share};
}

}  // namespace

std::optional<EngineMotion> start_motion(const OnBoardModel& model, const sim::Operation& operation,
                                         const std::array<double, speed_count>& measured_rpm,
                                         sim::OnBoardEngine& engine) noexcept {
  constexpr double dt_s = 0.05, at_rest_percent_s = 1e-3;
  constexpr int longest = 400;
  if (!sim::covers(operation.flight)) return std::nullopt;
  const sim::DesignPoint& design = model.engine().data().design;
  const auto& inlet = model.engine().data().inlet;
  const double root_theta = sim::root_theta(inlet, operation.flight),
               root_design = sim::root_theta(inlet, design.flight);
  const auto share = shares(model, operation, root_theta, measured_rpm);
  EngineMotion motion;
  motion.speeds = {share[0] * design.speeds.n1_rpm * root_theta / root_design,
                   share[1] * design.speeds.n2_rpm * root_theta / root_design};
  const bool free_n1 = !std::isfinite(measured_rpm[0]), free_n2 = !std::isfinite(measured_rpm[1]);
  sim::GasPath gas;
  if (engine.evaluate(operation, motion.speeds, gas) != sim::GasPathStatus::ok) return std::nullopt;
  for (int k = 0; k < longest && (free_n1 || free_n2); ++k) {
    const double n1_rate = 100.0 * gas.n1_dot_rpm_s / design.speeds.n1_rpm,
                 n2_rate = 100.0 * gas.n2_dot_rpm_s / design.speeds.n2_rpm;
    if (free_n1) motion.speeds.n1_rpm += dt_s * gas.n1_dot_rpm_s;
    if (free_n2) motion.speeds.n2_rpm += dt_s * gas.n2_dot_rpm_s;
    if (engine.evaluate(operation, motion.speeds, gas) != sim::GasPathStatus::ok) return std::nullopt;
    if ((!free_n1 || std::abs(n1_rate) < at_rest_percent_s) && (!free_n2 || std::abs(n2_rate) < at_rest_percent_s))
      break;
  }
  motion.metal_k = gas.metal_k;
  return motion;
}

}  // namespace ehm::onboard
