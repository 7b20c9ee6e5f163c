// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/control/fan_speed_demand.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine_sim/control/scheduled_point.h"
#include "engine_sim/model/parts/root_theta.h"

namespace ehm::engine_sim {
namespace {

/// A change of these moves net thrust at constant fan speed by less than 0.1 % (0.1 % of pressure, of temperature).
bool alike(const FlightCondition& a, const FlightCondition& b) {
  return std::abs(a.altitude_m - b.altitude_m) < 5.0 && std::abs(a.mach - b.mach) < 5e-4 &&
         std::abs(a.delta_isa_k - b.delta_isa_k) < 0.1;
}

}  // namespace

double FanSpeedDemand::n1_rpm(const Demand& demand, const FlightCondition& flight) {
  if (demand.kind == DemandKind::n1_rpm) return demand.value;
  if (demand.kind != DemandKind::net_thrust_n) throw std::invalid_argument("control: demand is n1_rpm or net_thrust_n");
  if (!last_ || last_->net_thrust_n != demand.value || !alike(last_->flight, flight)) {
    last_ = Converted{demand.value, flight, converted(demand.value, flight)};
  }
  return last_->n1_rpm;
}

double FanSpeedDemand::most_net_thrust_n(const FlightCondition& flight) {
  return at_speed_limit(flight).gas.net_thrust_n;
}

double FanSpeedDemand::speed_limit_rpm(const FlightCondition& flight) const {
  return std::min(data_.limits.n1_rpm, data_.limits.n1_corrected_rpm * root_theta(engine_.data().inlet, flight));
}

SteadyPoint FanSpeedDemand::at_speed_limit(const FlightCondition& flight) {
  const SteadyPoint* near = near_ ? &*near_ : nullptr;
  const SteadyPoint most =
      solve_scheduled(engine_, data_, {.flight = flight}, {DemandKind::n1_rpm, speed_limit_rpm(flight)}, near);
  if (!near_) near_ = most;
  return most;
}

double FanSpeedDemand::converted(double net_thrust_n, const FlightCondition& flight) {
  if (net_thrust_n >= most_net_thrust_n(flight)) return speed_limit_rpm(flight);
  try {
    near_ = solve_scheduled(engine_, data_, {.flight = flight}, {DemandKind::net_thrust_n, net_thrust_n}, &*near_);
    return near_->gas.speeds.n1_rpm;
  } catch (const SolveError&) {
    return 0.0;  // less thrust than the engine gives where it runs: idle
  }
}

}  // namespace ehm::engine_sim
