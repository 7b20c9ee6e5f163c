// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/control/fuel_control.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"

namespace ehm::engine_sim {
namespace {

/// Relative change of fuel flow in this step, and the loop that wants it.
struct Selection {
  double change;
  FuelLoop loop;

  void raise_to(double other, FuelLoop by) {
    if (other > change) *this = {other, by};
  }
  void lower_to(double other, FuelLoop by) {
    if (other < change) *this = {other, by};
  }
};

}  // namespace

FuelControl::FuelControl(const ControlData& data, const Measurements& start, double fuel_flow_kg_s)
    : data_(data), fuel_flow_kg_s_(fuel_flow_kg_s), n1_reference_rpm_(start.n1_rpm), last_error_(errors(start)) {}

std::array<double, FuelControl::regulator_count> FuelControl::errors(const Measurements& m) const {
  const EngineLimits& limit = data_.limits;
  const double root_theta = std::sqrt(m.theta2());
  const double n1_max = std::min(limit.n1_rpm, limit.n1_corrected_rpm * root_theta);
  const double n2_max = std::min(limit.n2_rpm, limit.n2_corrected_rpm * root_theta);
  return {n1_reference_rpm_ / m.n1_rpm - 1.0,
          limit.idle_n2_corrected_rpm(m.on_ground) * root_theta / m.n2_rpm - 1.0,
          n1_max / m.n1_rpm - 1.0,
          n2_max / m.n2_rpm - 1.0,
          limit.t48_k / m.t48_k - 1.0,
          limit.ps_30_pa / m.ps_30_pa - 1.0};
}

std::array<double, FuelControl::regulator_count> FuelControl::increments(const Measurements& m, double dt_s) {
  const FuelControlData& f = data_.fuel;
  const double n1c = m.n1_corrected_rpm();
  const FuelResponse n1{scheduled(f.n1_gain, n1c), scheduled(f.n1_lag_s, n1c)};
  const FuelResponse n2{scheduled(f.n2_gain, n1c), scheduled(f.n2_lag_s, n1c)};
  const std::array<FuelResponse, regulator_count> response{n1, n2, n1, n2, f.t48, f.ps_30};
  const double w = f.speed_bandwidth_rad_s;
  const std::array<double, regulator_count> bandwidth{w, w, w, w, f.t48_bandwidth_rad_s, f.ps_30_bandwidth_rad_s};

  const std::array<double, regulator_count> error = errors(m);
  std::array<double, regulator_count> change;
  for (std::size_t i = 0; i < regulator_count; ++i) {
    const auto& [gain, lag_s_at_sea_level] = response[i];
    const double lag_s = lag_s_at_sea_level / m.delta2();
    // d ln Wf = (w/K) (T (e[k] - e[k-1]) + e[k] dt)
    change[i] = bandwidth[i] / gain * (lag_s * (error[i] - last_error_[i]) + error[i] * dt_s);
  }
  last_error_ = error;
  return change;
}

void FuelControl::follow(const Measurements& m, double n1_demand_rpm, double dt_s) {
  const FuelControlData& f = data_.fuel;
  const double n1c = m.n1_corrected_rpm();
  // proportional gain of the governor: relative fuel flow per relative speed
  const double proportional =
      f.speed_bandwidth_rad_s * scheduled(f.n1_lag_s, n1c) / (m.delta2() * scheduled(f.n1_gain, n1c));
  const double step_rpm = f.reference_fuel_rate_per_s / proportional * n1_demand_rpm * dt_s;
  const double near_rpm =
      std::clamp(n1_reference_rpm_, (1.0 - f.reference_band) * n1_demand_rpm, (1.0 + f.reference_band) * n1_demand_rpm);
  n1_reference_rpm_ = std::clamp(n1_demand_rpm, near_rpm - step_rpm, near_rpm + step_rpm);
}

double FuelControl::update(const Measurements& m, double n1_demand_rpm, double dt_s) {
  follow(m, n1_demand_rpm, dt_s);
  const auto change = increments(m, dt_s);
  const auto wanted_by = [&](FuelLoop loop) { return change[as_size(loop)]; };
  Selection selected{wanted_by(FuelLoop::n1_governor), FuelLoop::n1_governor};
  selected.raise_to(wanted_by(FuelLoop::n2_idle), FuelLoop::n2_idle);
  if (data_.hold_limits) {
    for (const FuelLoop limit : {FuelLoop::n1_limit, FuelLoop::n2_limit, FuelLoop::t48_limit, FuelLoop::ps_30_limit}) {
      selected.lower_to(wanted_by(limit), limit);
    }
  }
  const FuelControlData& f = data_.fuel;
  const double n2c = m.n2_corrected_rpm();
  const double ratio_unit_kg_s = fuel_per_ratio_unit(m, f.theta_exponent);
  const auto change_to = [&](double fuel_flow_kg_s) { return std::log(fuel_flow_kg_s / fuel_flow_kg_s_); };
  selected.lower_to(change_to(ratio_unit_kg_s * scheduled(f.acceleration, n2c)), FuelLoop::acceleration);
  selected.raise_to(change_to(ratio_unit_kg_s * scheduled(f.deceleration, n2c)), FuelLoop::deceleration);
  selected.lower_to(f.slew_per_s * dt_s, FuelLoop::slew);
  selected.raise_to(-f.slew_per_s * dt_s, FuelLoop::slew);
  selected.lower_to(change_to(f.fuel_max_kg_s), FuelLoop::valve_range);
  selected.raise_to(change_to(f.fuel_min_kg_s), FuelLoop::valve_range);
  active_ = selected.loop;
  return fuel_flow_kg_s_ *= std::exp(selected.change);
}

}  // namespace ehm::engine_sim
