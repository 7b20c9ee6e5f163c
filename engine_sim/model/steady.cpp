#include "engine_sim/model/steady.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace ehm::engine {
namespace {

constexpr std::size_t unknown_count = flow_unknown_count + 3;
using D = Dual<unknown_count>;
using Unknowns = std::array<double, unknown_count>;
enum Extra : std::size_t { n1 = flow_unknown_count, n2, fuel };

/// Where the engine is asked to be; the continuation moves along a straight line between two of these.
struct Target {
  Operation operation;
  Demand demand;
};

struct Solution {
  Unknowns x;
  GasPath gas;
  int iterations;
  double residual;
};

constexpr std::array<std::string_view, unknown_count> names() {
  std::array<std::string_view, unknown_count> n{};
  for (std::size_t i = 0; i < flow_unknown_count; ++i) n[i] = flow_balance_names[i];
  n[6] = "LP shaft power";
  n[7] = "HP shaft power";
  n[8] = "demand";
  return n;
}

constexpr std::array<double, unknown_count> extended(const std::array<double, flow_unknown_count>& flow, double speed,
                                                     double fuel_flow) {
  std::array<double, unknown_count> out{};
  for (std::size_t i = 0; i < flow_unknown_count; ++i) out[i] = flow[i];
  out[n1] = out[n2] = speed;
  out[fuel] = fuel_flow;
  return out;
}

constexpr NewtonProblem<unknown_count> steady_balance{names(), extended(flow_unknown_box::lower, 0.05, 1e-3),
                                                      extended(flow_unknown_box::upper, 1.5, 4.0),
                                                      extended(flow_unknown_box::largest_step, 0.15, 0.3)};

/// Relative to the demand: (value - target)/target; thrust, which may be zero or negative, relative to the engine's
/// size.
D demand_residual(const Demand& demand, const CycleInput<D>& input, const Cycle<D>& c) {
  switch (demand.kind) {
    case DemandKind::fuel_flow_kg_s:
      return input.fuel_flow_kg_s / demand.value - 1.0;
    case DemandKind::n1_rpm:
      return input.n1_rpm / demand.value - 1.0;
    case DemandKind::net_thrust_n:
      return (c.net_thrust_n - demand.value) / value(c.gross_thrust_n);
    case DemandKind::t40_k:
      return c.s40.tt_k / demand.value - 1.0;
  }
  throw std::invalid_argument("steady: unknown kind of demand");
}

void require_valid(const Demand& demand) {
  const bool positive = demand.kind == DemandKind::net_thrust_n || demand.value > 0.0;
  if (std::isfinite(demand.value) && positive) return;
  constexpr std::array<const char*, 4> kinds{"fuel_flow_kg_s", "n1_rpm", "net_thrust_n", "t40_k"};
  throw std::invalid_argument(std::string("steady: demand ") + kinds[static_cast<std::size_t>(demand.kind)] + " = " +
                              std::to_string(demand.value) + " must be finite" +
                              (demand.kind == DemandKind::net_thrust_n ? "" : " and above zero"));
}

/// Newton's method at one target from one start.
Solution solve_at(const Turbofan& engine, const Target& target, Unknowns x) {
  const DesignPoint& design = engine.data().design;
  const Intake in = intake(engine.data().inlet, target.operation.flight);
  CycleInput<D> input;
  Cycle<D> last;
  const NewtonReport report = newton(steady_balance, x, [&](const std::array<D, unknown_count>& trial) {
    input = {trial[n1] * design.speeds.n1_rpm, trial[n2] * design.speeds.n2_rpm, trial[fuel] * design.fuel_flow_kg_s,
             unpack(trial)};
    last = engine.cycle(in, target.operation, input);
    std::array<D, unknown_count> r;
    std::copy(last.flow_residual.begin(), last.flow_residual.end(), r.begin());
    r[6] = 1.0 - last.lp_absorbed_power_w / last.lp_turbine_power_w;
    r[7] = 1.0 - last.hp_absorbed_power_w / last.hp_turbine_power_w;
    r[8] = demand_residual(target.demand, input, last);
    return r;
  });
  return {x, engine.report(input, last), report.iterations, report.residual};
}

Unknowns unknowns_of(const Turbofan& engine, const FlowUnknowns& flow, const SpoolSpeeds& speeds,
                     double fuel_flow_kg_s) {
  const DesignPoint& design = engine.data().design;
  Unknowns x = extended(pack(flow), 0.0, fuel_flow_kg_s / design.fuel_flow_kg_s);
  x[n1] = speeds.n1_rpm / design.speeds.n1_rpm;
  x[n2] = speeds.n2_rpm / design.speeds.n2_rpm;
  return x;
}

/// The design point's unknowns moved to another inlet state at constant corrected speeds and corrected fuel flow.
Unknowns cold_start(const Turbofan& engine, const Target& target) {
  const DesignPoint& design = engine.data().design;
  const Intake here = intake(engine.data().inlet, target.operation.flight),
               there = intake(engine.data().inlet, design.flight);
  const double root_theta = std::sqrt(here.tt_k / there.tt_k);
  Unknowns x = unknowns_of(engine, design.unknowns, design.speeds, design.fuel_flow_kg_s);
  x[n1] *= root_theta;
  x[n2] *= root_theta;
  x[fuel] *= here.fan_face_pt_pa / there.fan_face_pt_pa * root_theta;
  return x;
}

double demanded_value(const GasPath& gas, DemandKind kind) {
  switch (kind) {
    case DemandKind::fuel_flow_kg_s:
      return gas.fuel_flow_kg_s;
    case DemandKind::n1_rpm:
      return gas.speeds.n1_rpm;
    case DemandKind::net_thrust_n:
      return gas.net_thrust_n;
    case DemandKind::t40_k:
      return gas.s40.tt_k;
  }
  throw std::invalid_argument("steady: unknown kind of demand");
}

Target between(const Target& a, const Target& b, double share) {
  const auto mean = [share](double from, double to) { return from + share * (to - from); };
  const Operation &p = a.operation, &q = b.operation;
  Target t = b;
  t.operation.flight = {mean(p.flight.altitude_m, q.flight.altitude_m), mean(p.flight.mach, q.flight.mach),
                        mean(p.flight.delta_isa_k, q.flight.delta_isa_k)};
  for (std::size_t i = 0; i < health_count; ++i) t.operation.health[i] = mean(p.health[i], q.health[i]);
  t.operation.geometry = {mean(p.geometry.vsv_deg, q.geometry.vsv_deg),
                          mean(p.geometry.vbv_fraction, q.geometry.vbv_fraction),
                          mean(p.geometry.core_nozzle_area_ratio, q.geometry.core_nozzle_area_ratio)};
  t.operation.offtake = {mean(p.offtake.customer_bleed_kg_s, q.offtake.customer_bleed_kg_s),
                         mean(p.offtake.power_w, q.offtake.power_w)};
  t.demand.value = mean(a.demand.value, b.demand.value);
  return t;
}

/// Walks from a solved target to another one; a failed step is halved, a successful one doubled.
Solution follow(const Turbofan& engine, const Target& from, const Target& to, Solution at) {
  double share = 0.0, step = 0.25;
  int iterations = at.iterations;
  while (share < 1.0) {
    const double next = std::min(1.0, share + step);
    try {
      at = solve_at(engine, between(from, to, next), at.x);
      iterations += at.iterations;
      share = next;
      step *= 2.0;
    } catch (const SolveError&) {
      step *= 0.5;
      if (step < 1e-3) throw;
    }
  }
  at.iterations = iterations;
  return at;
}

/// First flight condition and health at the corrected design fuel flow, then the demand.
Solution continuation(const Turbofan& engine, const Target& target) {
  const DesignPoint& design = engine.data().design;
  const Target origin{{.flight = design.flight}, {DemandKind::fuel_flow_kg_s, design.fuel_flow_kg_s}};
  Solution at = solve_at(engine, origin, cold_start(engine, origin));
  Target moved = target;
  moved.demand = {DemandKind::fuel_flow_kg_s, 0.7 * cold_start(engine, target)[fuel] * design.fuel_flow_kg_s};
  at = follow(engine, origin, moved, at);
  moved.demand = {target.demand.kind, demanded_value(at.gas, target.demand.kind)};
  return follow(engine, moved, target, at);
}

Solution solve(const Turbofan& engine, const Target& target, const Unknowns& start) {
  try {
    return solve_at(engine, target, start);
  } catch (const SolveError&) {
    return continuation(engine, target);
  }
}

}  // namespace

SteadyPoint solve_steady(const Turbofan& engine, const Operation& operation, const Demand& demand,
                         const SteadyPoint* start) {
  require_valid(demand);
  Operation held = operation;
  held.fuel_flow_kg_s = engine.data().design.fuel_flow_kg_s;
  require_valid(held);
  const Target target{held, demand};
  const Unknowns x = start ? unknowns_of(engine, start->unknowns, start->gas.speeds, start->gas.fuel_flow_kg_s)
                           : cold_start(engine, target);
  const Solution s = solve(engine, target, x);
  held.fuel_flow_kg_s = s.gas.fuel_flow_kg_s;
  return {held, s.gas, {unpack(s.x)}, s.iterations, s.residual};
}

}  // namespace ehm::engine
