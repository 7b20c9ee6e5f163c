// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/control/scheduled_point.h"

#include <cmath>

#include "engine_sim/control/controlled_engine.h"
#include "engine_sim/model/parts/root_theta.h"
#include "engine_sim/model/ratings.h"

namespace ehm::engine_sim {
namespace {

/// Would the control leave the engine there?
bool held(const ControlData& data, const Measurements& m) {
  const EngineLimits& limit = data.limits;
  if (m.n2_corrected_rpm() < limit.idle_n2_corrected_rpm(m.on_ground)) return false;
  if (!data.hold_limits) return true;
  return m.n1_rpm <= limit.n1_rpm && m.n1_corrected_rpm() <= limit.n1_corrected_rpm && m.n2_rpm <= limit.n2_rpm &&
         m.n2_corrected_rpm() <= limit.n2_corrected_rpm && m.t48_k <= limit.t48_k && m.ps_30_pa <= limit.ps_30_pa;
}

/// Lets the control fly from a steady point in the middle of its range until the spools rest.
SteadyPoint flown_to(const Turbofan& engine, const ControlData& data, const Surroundings& surroundings,
                     double n1_demand_rpm) {
  constexpr double dt_s = 0.015, rest_rpm_s = 0.01;
  constexpr int longest = 20'000;
  const double middle_n1_rpm = data.middle_n1_corrected_rpm * root_theta(engine.data().inlet, surroundings.flight);
  const SteadyPoint middle = solve_scheduled(engine, data, surroundings, {DemandKind::n1_rpm, middle_n1_rpm});
  ControlledEngine run(engine, data, middle);
  ControlledSample last = run.step(surroundings, n1_demand_rpm, dt_s);
  for (int k = 0; k < longest; ++k) {
    last = run.step(surroundings, n1_demand_rpm, dt_s);
    if (k > 100 && std::abs(last.gas.n1_dot_rpm_s) + std::abs(last.gas.n2_dot_rpm_s) < rest_rpm_s) break;
  }
  return solve_scheduled(engine, data, surroundings, {DemandKind::n1_rpm, last.gas.speeds.n1_rpm}, &middle);
}

}  // namespace

SteadyPoint solve_scheduled(const Turbofan& engine, const ControlData& data, const Surroundings& surroundings,
                            const Demand& demand, const SteadyPoint* start) {
  constexpr double close_enough = 1e-9;  // of the flow, far below what any reading shows
  constexpr int rounds = 50;
  Operation operation{.flight = surroundings.flight, .health = surroundings.health, .offtake = surroundings.offtake};
  SteadyPoint point = solve_steady(engine, operation, demand, start);
  for (int i = 0; i < rounds; ++i) {
    const double command =
        bleed_valve_command(data, measure(point.gas, on_ground(surroundings.flight)), point.gas.fuel_flow_kg_s);
    if (std::abs(command - operation.geometry.vbv_fraction) < close_enough) return point;
    operation.geometry.vbv_fraction = command;
    point = solve_steady(engine, operation, demand, &point);
  }
  throw SolveError("the bleed valves find no steady position");
}

SteadyPoint settled(const Turbofan& engine, const ControlData& data, const Surroundings& surroundings,
                    double n1_demand_rpm) {
  try {
    if (n1_demand_rpm > 0.0) {
      const SteadyPoint point = solve_scheduled(engine, data, surroundings, {DemandKind::n1_rpm, n1_demand_rpm});
      if (held(data, measure(point.gas, on_ground(surroundings.flight)))) return point;
    }
  } catch (const SolveError&) {
    // no such steady point: what the control makes of the demand is found by flying
  }
  return flown_to(engine, data, surroundings, n1_demand_rpm);
}

}  // namespace ehm::engine_sim
