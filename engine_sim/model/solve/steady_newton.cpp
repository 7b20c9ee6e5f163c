// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/solve/steady_newton.h"

#include <cmath>

#include "engine_sim/model/ratings.h"

namespace ehm::engine_sim::steady {
namespace {

using D = Dual<unknown_count>;

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
D demand_residual(const Ratings& ratings, double tt2_k, const Demand& demand, const CycleInput<D>& input,
                  const Cycle<D>& c) {
  switch (demand.kind) {
    case DemandKind::fuel_flow_kg_s:
      return input.fuel_flow_kg_s / demand.value - 1.0;
    case DemandKind::n1_rpm:
      return input.n1_rpm / demand.value - 1.0;
    case DemandKind::net_thrust_n:
      return (c.net_thrust_n - demand.value) / value(c.gross_thrust_n);
    case DemandKind::t40_k:
      return c.s40.tt_k / demand.value - 1.0;
    case DemandKind::n2_rpm:
      return input.n2_rpm / demand.value - 1.0;
    case DemandKind::limit_ratio:
      return limit_ratio(ratings, c.s40.tt_k, c.s48.tt_k, c.s30.pt_pa, input.n1_rpm, input.n2_rpm, tt2_k) /
                 demand.value -
             1.0;
  }
  throw std::invalid_argument("steady: unknown kind of demand");
}

/// `closing(in, trial, input, cycle)` is the ninth residual.
template <class Closing>
Solution solve_closed_by(const Turbofan& engine, const Operation& operation, Unknowns x, Closing&& closing) {
  const EngineData& data = engine.data();
  const Intake in = intake(data.inlet, operation.flight);
  CycleInput<D> input;
  Cycle<D> last;
  const NewtonReport report = newton(steady_balance, x, [&](const std::array<D, unknown_count>& trial) {
    input = {trial[n1] * data.design.speeds.n1_rpm, trial[n2] * data.design.speeds.n2_rpm,
             trial[fuel] * data.design.fuel_flow_kg_s, unpack(trial)};
    last = engine.cycle(in, operation, input);
    std::array<D, unknown_count> r;
    std::copy(last.flow_residual.begin(), last.flow_residual.end(), r.begin());
    r[6] = 1.0 - last.lp_absorbed_power_w / last.lp_turbine_power_w;
    r[7] = 1.0 - last.hp_absorbed_power_w / last.hp_turbine_power_w;
    r[8] = closing(in, trial, input, last);
    return r;
  });
  return {x, engine.report(input, last), report.iterations, report.residual};
}

}  // namespace

Solution solve_at(const Turbofan& engine, const Target& target, const Unknowns& x) {
  return solve_closed_by(engine, target.operation, x,
                         [&](const Intake& in, const auto&, const auto& input, auto& cycle) {
                           return demand_residual(engine.data().ratings, in.tt_k, target.demand, input, cycle);
                         });
}

Solution solve_on(const Turbofan& engine, const Operation& operation, const Plane& plane, const Unknowns& x) {
  return solve_closed_by(engine, operation, x, [&](const Intake&, const auto& trial, const auto&, const auto&) {
    D distance = 0.0;
    for (std::size_t i = 0; i < unknown_count; ++i)
      distance = distance + plane.normal[i] * (trial[i] - plane.through[i]);
    return distance;
  });
}

Unknowns unknowns_of(const Turbofan& engine, const FlowUnknowns& flow, const SpoolSpeeds& speeds,
                     double fuel_flow_kg_s) {
  const DesignPoint& design = engine.data().design;
  Unknowns x = extended(pack(flow), 0.0, fuel_flow_kg_s / design.fuel_flow_kg_s);
  x[n1] = speeds.n1_rpm / design.speeds.n1_rpm;
  x[n2] = speeds.n2_rpm / design.speeds.n2_rpm;
  return x;
}

Unknowns cold_start(const Turbofan& engine, const FlightCondition& flight) {
  const DesignPoint& design = engine.data().design;
  const Intake here = intake(engine.data().inlet, flight), there = intake(engine.data().inlet, design.flight);
  const double root_theta = std::sqrt(here.tt_k / there.tt_k);
  Unknowns x = unknowns_of(engine, design.unknowns, design.speeds, design.fuel_flow_kg_s);
  x[n1] *= root_theta;
  x[n2] *= root_theta;
  x[fuel] *= here.fan_face_pt_pa / there.fan_face_pt_pa * root_theta;
  return x;
}

double demanded_value(const Turbofan& engine, const GasPath& gas, DemandKind kind) {
  switch (kind) {
    case DemandKind::fuel_flow_kg_s:
      return gas.fuel_flow_kg_s;
    case DemandKind::n1_rpm:
      return gas.speeds.n1_rpm;
    case DemandKind::net_thrust_n:
      return gas.net_thrust_n;
    case DemandKind::t40_k:
      return gas.s40.tt_k;
    case DemandKind::n2_rpm:
      return gas.speeds.n2_rpm;
    case DemandKind::limit_ratio:
      return limit_ratio(engine.data().ratings, gas);
  }
  throw std::invalid_argument("steady: unknown kind of demand");
}

}  // namespace ehm::engine_sim::steady
