#include "engine_sim/control/controlled_engine.h"

#include <cmath>

namespace ehm::engine {
namespace {

Measurements at(Measurements measured, const SpoolSpeeds& speeds, const Intake& intake) {
  measured.n1_rpm = speeds.n1_rpm;
  measured.n2_rpm = speeds.n2_rpm;
  measured.t2_k = intake.tt_k;
  measured.p2_pa = intake.fan_face_pt_pa;
  return measured;
}

bool within(const EngineLimits& limits, const Measurements& m) {
  return m.n1_rpm <= limits.n1_rpm && m.n1_corrected_rpm() <= limits.n1_corrected_rpm && m.n2_rpm <= limits.n2_rpm &&
         m.n2_corrected_rpm() <= limits.n2_corrected_rpm && m.t48_k <= limits.t48_k && m.ps_30_pa <= limits.ps_30_pa &&
         m.n2_corrected_rpm() >= limits.idle_n2_corrected_rpm;
}

/// Lets the control fly from a steady point in the middle of its range until the spools rest.
SteadyPoint flown_to(const Turbofan& engine, const ControlData& data, const Surroundings& surroundings,
                     double n1_demand_rpm) {
  constexpr double middle_n1_corrected_rpm = 3000.0, dt_s = 0.015, rest_rpm_s = 0.01;
  constexpr int longest = 20'000;
  const double root_theta = std::sqrt(intake(engine.data().inlet, surroundings.flight).tt_k / reference_temperature_k);
  const SteadyPoint middle =
      solve_scheduled(engine, data, surroundings, {DemandKind::n1_rpm, middle_n1_corrected_rpm * root_theta});
  ControlledEngine run(engine, data, middle);
  ControlledSample last = run.step(surroundings, n1_demand_rpm, dt_s);
  for (int k = 0; k < longest; ++k) {
    last = run.step(surroundings, n1_demand_rpm, dt_s);
    if (k > 100 && std::abs(last.gas.n1_dot_rpm_s) + std::abs(last.gas.n2_dot_rpm_s) < rest_rpm_s) break;
  }
  return solve_scheduled(engine, data, surroundings, {DemandKind::n1_rpm, last.gas.speeds.n1_rpm}, &middle);
}

}  // namespace

ControlledEngine::ControlledEngine(const Turbofan& engine, const ControlData& data, const SteadyPoint& start)
    : engine_(engine),
      control_(data, measure(start.gas), start.operation.fuel_flow_kg_s),
      transient_(engine, start),
      measured_(measure(start.gas)) {}

ControlledSample ControlledEngine::step(const Surroundings& surroundings, double n1_demand_rpm, double dt_s) {
  measured_ = at(measured_, transient_.speeds(), intake(engine_.data().inlet, surroundings.flight));
  const Actuation actuation = control_.update(measured_, n1_demand_rpm, dt_s);
  const Operation operation{.flight = surroundings.flight,
                            .health = surroundings.health,
                            .fuel_flow_kg_s = actuation.fuel_flow_kg_s,
                            .geometry = geometry(control_.data().vanes, actuation, measured_),
                            .offtake = surroundings.offtake};
  const GasPath gas = transient_.output(operation);
  measured_ = measure(gas);
  transient_.step(operation, dt_s);
  return {actuation, gas};
}

SteadyPoint solve_scheduled(const Turbofan& engine, const ControlData& data, const Surroundings& surroundings,
                            const Demand& demand, const SteadyPoint* start) {
  constexpr double close_enough = 1e-9;  // of the flow, far below what any reading shows
  constexpr int rounds = 50;
  Operation operation{.flight = surroundings.flight, .health = surroundings.health, .offtake = surroundings.offtake};
  SteadyPoint point = solve_steady(engine, operation, demand, start);
  for (int i = 0; i < rounds; ++i) {
    const double command = bleed_valve_command(data, measure(point.gas), point.gas.fuel_flow_kg_s);
    if (std::abs(command - operation.geometry.vbv_fraction) < close_enough) return point;
    operation.geometry.vbv_fraction = command;
    point = solve_steady(engine, operation, demand, &point);
  }
  return point;
}

SteadyPoint settled(const Turbofan& engine, const ControlData& data, const Surroundings& surroundings,
                    double n1_demand_rpm) {
  try {
    const SteadyPoint point = solve_scheduled(engine, data, surroundings, {DemandKind::n1_rpm, n1_demand_rpm});
    if (within(data.limits, measure(point.gas))) return point;
  } catch (const SolveError&) {
    // no such steady point: what the control makes of the demand is found by flying
  }
  return flown_to(engine, data, surroundings, n1_demand_rpm);
}

}  // namespace ehm::engine
