// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/turbofan.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine_sim/model/onboard/gas_path_inputs.h"
#include "engine_sim/model/parts/combustor.h"
#include "engine_sim/model/parts/duct.h"
#include "engine_sim/model/parts/shaft.h"
#include "engine_sim/model/solve/flow_balance.h"
#include "engine_sim/model/thermo/static_pressure.h"

namespace ehm::engine_sim {
namespace {

constexpr double lowest_nozzle_ratio = 1.0005;
/// Beyond these no combustor burns and the gas data end (gas.h).
constexpr double richest = 0.05, hottest_k = 2000.0;

/// Keeps the first value that is outside its range.
class RangeCheck {
 public:
  void require(bool ok, GasPathStatus kind, std::string_view key, double value, const char* range) {
    if (ok || first_) return;
    first_ = {std::isfinite(value) ? kind : GasPathStatus::not_finite, key, value, range};
  }
  const std::optional<InputDefect>& first() const { return first_; }

 private:
  std::optional<InputDefect> first_;
};

void require_none(const std::optional<InputDefect>& defect) {
  if (!defect) return;
  throw std::invalid_argument("engine: " + std::string(defect->key) + " = " + std::to_string(defect->value) +
                              " is outside " + defect->range);
}

template <class P>
struct ComponentFactors {
  MapFactors<P> fan, lpc, hpc, hpt, lpt;
};

template <class P>
ComponentFactors<P> component_factors(const Turbofan& engine, const OperationOf<P>& operation) {
  const HealthVectorOf<P>& h = operation.health;
  return {map_factors<P>({h[fan_efficiency], h[fan_flow]}), map_factors<P>({h[lpc_efficiency], h[lpc_flow]}),
          map_factors<P>({h[hpc_efficiency], h[hpc_flow]}, engine.data().hpc.vanes, operation.geometry.vsv_deg),
          map_factors<P>({h[hpt_efficiency], h[hpt_flow]}), map_factors<P>({h[lpt_efficiency], h[lpt_flow]})};
}

/// mix(), spared where there is nothing to add.
template <class S>
Stream<S> joined(const Stream<S>& main, const Stream<S>& added) {
  return vanishes(added.w_kg_s) ? main : mix(main, added);
}

/// From the fan's bypass exit to the bypass nozzle.
template <class S>
Stream<S> bypass(const EngineData& data, const Stream<S>& s13, const Stream<S>& bleed_valves) {
  return joined(duct(with_flow(s13, S(s13.w_kg_s * (1.0 - data.air.bypass_leak))), data.loss.bypass), bleed_valves);
}

/// Heat soak of one component, if there are metal temperatures.
template <class S, class P>
Stream<S> soaked(const EngineData& data, Cycle<S>& c, Metal lump, const Stream<S>& in,
                 const MetalTemperaturesOf<P>* metal) {
  if (metal == nullptr) return in;
  const Soaked<S> out = soak(data.metal[lump], in, (*metal)[lump]);
  c.metal_heat_w[lump] = out.heat_w;
  return out.gas;
}

/// Air that is left for the combustor.
template <class S>
double combustor_air_kg_s(const CycleInput<S>& input, const Cycle<S>& c) {
  return value(c.s40.w_kg_s) - value(input.fuel_flow_kg_s);
}

template <class S>
FlowDefect flow_defect(const CycleInput<S>& input, const Cycle<S>& c) {
  if (!(value(c.core_nozzle_pressure_ratio) > lowest_nozzle_ratio)) return FlowDefect::core_nozzle;
  if (!(value(c.bypass_nozzle_pressure_ratio) > lowest_nozzle_ratio)) return FlowDefect::bypass_nozzle;
  const bool burns =
      combustor_air_kg_s(input, c) > 0.0 && value(c.s40.fuel_air_ratio) <= richest && value(c.s40.tt_k) <= hottest_k;
  return burns ? FlowDefect::none : FlowDefect::combustor;
}

[[noreturn]] void throw_closed_nozzle(const char* name, double pressure_ratio) {
  throw SolveError(std::string("residual '") + name + " nozzle flow': pressure ratio " +
                   std::to_string(pressure_ratio) +
                   " drives no jet (windmilling is not modelled); give more fuel flow");
}

[[noreturn]] void throw_no_combustion(double air_kg_s, const Station& s40) {
  throw SolveError("residual 'combustor': " + std::to_string(air_kg_s) + " kg/s of air, fuel-air ratio " +
                   std::to_string(s40.fuel_air_ratio) + ", T40 " + std::to_string(s40.tt_k) +
                   " K; there must be air, and at most " + std::to_string(richest) + " and " +
                   std::to_string(hottest_k) + " K");
}

[[noreturn]] void throw_choked_exit(double w_kg_s, double area_m2) {
  throw SolveError("residual 'static pressure': a flow of " + std::to_string(w_kg_s) + " kg/s chokes the area of " +
                   std::to_string(area_m2) + " m2");
}

template <class S>
S closure(const S& flow, const S& capacity) {
  return 1.0 - capacity / flow;
}

}  // namespace

std::optional<InputDefect> first_defect(const Operation& operation) noexcept {
  using enum GasPathStatus;
  RangeCheck check;
  const double wf = operation.fuel_flow_kg_s;
  check.require(std::isfinite(wf) && wf > 0.0, outside_fuel, "fuel_flow_kg_s", wf,
                "0 < value < infinity (windmilling is not modelled)");
  for (std::size_t i = 0; i < health_count; ++i) {
    const double h = operation.health[i];
    check.require(h >= -0.5 && h <= 0.5, outside_health, health_names[i], h, "-0.5 to 0.5 (health)");
  }
  const auto& [vsv_deg, vbv_fraction, area_ratio] = operation.geometry;
  check.require(vsv_deg >= -20.0 && vsv_deg <= 40.0, outside_controls, "vsv_deg", vsv_deg, "-20 to 40");
  check.require(vbv_fraction >= 0.0 && vbv_fraction <= 0.5, outside_controls, "vbv_fraction", vbv_fraction, "0 to 0.5");
  check.require(area_ratio >= 0.5 && area_ratio <= 2.0, outside_controls, "core_nozzle_area_ratio", area_ratio,
                "0.5 to 2");
  const auto& [bleed_kg_s, power_w] = operation.offtake;
  check.require(bleed_kg_s >= 0.0 && bleed_kg_s <= 100.0, outside_controls, "customer_bleed_kg_s", bleed_kg_s,
                "0 to 100");
  check.require(power_w >= 0.0 && power_w <= 1e7, outside_controls, "power_offtake_w", power_w, "0 to 1e7");
  return check.first();
}

std::optional<InputDefect> first_defect(const SpoolSpeeds& speeds) noexcept {
  RangeCheck check;
  for (const auto& [key, rpm] : {std::pair{"n1_rpm", speeds.n1_rpm}, std::pair{"n2_rpm", speeds.n2_rpm}}) {
    check.require(rpm > 0.0 && std::isfinite(rpm), GasPathStatus::outside_speeds, key, rpm, "0 < value < infinity");
  }
  return check.first();
}

void require_valid(const Operation& operation) {
  require_none(first_defect(operation));
}

void require_valid(const SpoolSpeeds& speeds) {
  require_none(first_defect(speeds));
}

//  ambient -> inlet -2- fan -+-13- bypass duct (+ VBV air) -15-> bypass nozzle
//                            +-21- duct -22- LPC -24- VBV, duct -25- HPC -30- bleeds -36- combustor -40-
//  -40- HPT (+ cooling) -45- duct -48- LPT (+ cooling) -50- duct -7-> core nozzle
template <class S, class P>
Cycle<S> Turbofan::cycle(const Intake& in, const OperationOf<P>& operation, const CycleInput<S>& input,
                         const std::type_identity_t<MetalTemperaturesOf<P>>* metal) const noexcept {
  const FlowUnknownsOf<S>& x = input.unknowns;
  const GeometryOf<P>& geometry = operation.geometry;
  const ComponentFactors<P> f = component_factors(*this, operation);
  Cycle<S> c;

  // fan: its map defines the flow of the engine; core and bypass leave it in the same state
  const S pt2 = S(in.fan_face_pt_pa), tt2 = S(in.tt_k);
  const auto fan_map = read_map(data_.fan, pt2, tt2, input.n1_rpm, x.r_line_fan, f.fan);
  c.s2 = make_stream(fan_map.flow_capacity_kg_s, pt2, tt2, S(0.0));
  c.fan = compress(data_.fan, c.s2, fan_map, f.fan);
  c.s21 = with_flow(c.fan.exit, S(c.s2.w_kg_s / (1.0 + x.bypass_ratio)));
  c.s13 = with_flow(c.fan.exit, S(c.s2.w_kg_s - c.s21.w_kg_s));

  const Stream<S> s22 = duct(c.s21, data_.loss.fan_to_lpc);
  const auto lpc_map = read_map(data_.lpc, s22.pt_pa, s22.tt_k, input.n1_rpm, x.r_line_lpc, f.lpc);
  c.lpc = compress(data_.lpc, s22, lpc_map, f.lpc);
  c.s24 = c.lpc.exit;

  const Stream<S> s15 = bypass(data_, c.s13, with_flow(c.s24, S(c.s24.w_kg_s * geometry.vbv_fraction)));
  const auto bypass_jet = exhaust(data_.bypass_nozzle, s15, in.ambient_p_pa, P(1.0));

  const Stream<S> s25 = duct(with_flow(c.s24, S(c.s24.w_kg_s * (1.0 - geometry.vbv_fraction))), data_.loss.lpc_to_hpc);
  const auto hpc_map = read_map(data_.hpc, s25.pt_pa, s25.tt_k, input.n2_rpm, x.r_line_hpc, f.hpc);
  c.hpc = compress(data_.hpc, s25, hpc_map, f.hpc);
  c.s30 = soaked(data_, c, hpc_metal, c.hpc.exit, metal);

  const Bleeds<S> bleeds = bleed_off(s25, c.hpc, c.s30, data_.air, operation.offtake.customer_bleed_kg_s);
  c.s40 = burn(data_.combustor, bleeds.main, input.fuel_flow_kg_s);

  const auto hpt =
      expand(data_.hpt, c.s40, joined(c.s40, bleeds.to_hpt_inlet), input.n2_rpm, x.pressure_ratio_hpt, f.hpt);
  const Stream<S> s45 = soaked(data_, c, hpt_metal, joined(hpt.exit, bleeds.to_hpt_exit), metal);
  c.s48 = duct(s45, data_.loss.hpt_to_lpt);

  const auto lpt =
      expand(data_.lpt, c.s48, joined(c.s48, bleeds.to_lpt_inlet), input.n1_rpm, x.pressure_ratio_lpt, f.lpt);
  c.s50 = soaked(data_, c, lpt_metal, joined(lpt.exit, bleeds.to_lpt_exit), metal);
  const Stream<S> s7 = duct(c.s50, data_.loss.lpt_to_nozzle);
  const auto core_jet = exhaust(data_.core_nozzle, s7, in.ambient_p_pa, geometry.core_nozzle_area_ratio);

  c.hp_turbine_power_w = hpt.power_w;
  c.hp_absorbed_power_w = bleeds.power_w + operation.offtake.power_w;
  c.lp_turbine_power_w = lpt.power_w;
  c.lp_absorbed_power_w = c.s2.w_kg_s * c.fan.work_j_kg + s22.w_kg_s * c.lpc.work_j_kg;
  c.gross_thrust_n = core_jet.gross_thrust_n + bypass_jet.gross_thrust_n;
  c.net_thrust_n = c.gross_thrust_n - c.s2.w_kg_s * in.flight_speed_m_s;
  c.core_nozzle_pressure_ratio = s7.pt_pa / in.ambient_p_pa;
  c.bypass_nozzle_pressure_ratio = s15.pt_pa / in.ambient_p_pa;
  c.flow_residual = {
      closure(s22.w_kg_s, c.lpc.flow_capacity_kg_s),   closure(s25.w_kg_s, c.hpc.flow_capacity_kg_s),
      closure(c.s40.w_kg_s, hpt.flow_capacity_kg_s),   closure(c.s48.w_kg_s, lpt.flow_capacity_kg_s),
      closure(s7.w_kg_s, core_jet.flow_capacity_kg_s), closure(s15.w_kg_s, bypass_jet.flow_capacity_kg_s)};
  return c;
}

template <class S, class T>
FlowDefect Turbofan::publish(const CycleInput<S>& input, const Cycle<S>& c, GasPathOf<T>& g) const noexcept {
  if (const FlowDefect defect = flow_defect(input, c); defect != FlowDefect::none) return defect;
  g.s2 = to_station<T>(c.s2);
  g.s13 = to_station<T>(c.s13);
  g.s21 = to_station<T>(c.s21);
  g.s24 = to_station<T>(c.s24);
  g.s30 = to_station<T>(c.s30);
  g.s40 = to_station<T>(c.s40);
  g.s48 = to_station<T>(c.s48);
  g.s50 = to_station<T>(c.s50);
  g.metal_k = {g.s30.tt_k, g.s48.tt_k, g.s50.tt_k};  // the duct behind the HPT keeps the temperature
  const auto exit = subsonic_state(to_station(c.s30), data_.hpc_exit_area_m2);
  if (!exit) return FlowDefect::hpc_exit;
  g.ps_30_pa = static_pressure(g.s30, *exit);
  g.speeds = {carried<T>(input.n1_rpm), carried<T>(input.n2_rpm)};
  g.n1_dot_rpm_s = shaft_acceleration_rpm_s<T>(carried<T>(c.lp_turbine_power_w) - carried<T>(c.lp_absorbed_power_w),
                                               g.speeds.n1_rpm, data_.lp_inertia_kg_m2);
  for (std::size_t i = 0; i < metal_count; ++i) {
    g.metal_dot_k_s[i] = carried<T>(c.metal_heat_w[i]) / data_.metal[i].capacity_j_k;
  }
  g.n2_dot_rpm_s = shaft_acceleration_rpm_s<T>(carried<T>(c.hp_turbine_power_w) - carried<T>(c.hp_absorbed_power_w),
                                               g.speeds.n2_rpm, data_.hp_inertia_kg_m2);
  g.fuel_flow_kg_s = carried<T>(input.fuel_flow_kg_s);
  g.net_thrust_n = carried<T>(c.net_thrust_n);
  g.gross_thrust_n = carried<T>(c.gross_thrust_n);
  g.bypass_ratio = carried<T>(input.unknowns.bypass_ratio);
  g.overall_pressure_ratio = g.s30.pt_pa / g.s2.pt_pa;
  g.stall_margin_fan_percent = stall_margin_percent<T>(data_.fan, c.fan);
  g.stall_margin_lpc_percent = stall_margin_percent<T>(data_.lpc, c.lpc);
  g.stall_margin_hpc_percent = stall_margin_percent<T>(data_.hpc, c.hpc);
  return FlowDefect::none;
}

template <class S>
GasPath Turbofan::report(const CycleInput<S>& input, const Cycle<S>& c) const {
  GasPath g;
  switch (publish(input, c, g)) {
    case FlowDefect::core_nozzle:
      throw_closed_nozzle("core", value(c.core_nozzle_pressure_ratio));
    case FlowDefect::bypass_nozzle:
      throw_closed_nozzle("bypass", value(c.bypass_nozzle_pressure_ratio));
    case FlowDefect::combustor:
      throw_no_combustion(combustor_air_kg_s(input, c), to_station(c.s40));
    case FlowDefect::hpc_exit:
      throw_choked_exit(value(c.s30.w_kg_s), data_.hpc_exit_area_m2);
    case FlowDefect::none:
      break;
  }
  return g;
}

GasPath Turbofan::gas_path(const Operation& operation, const SpoolSpeeds& speeds, FlowUnknowns& unknowns,
                           const MetalTemperatures* metal) const {
  return FlowBalance(*this).solve(operation, speeds, unknowns, metal);
}

template Cycle<double> Turbofan::cycle(const Intake&, const Operation&, const CycleInput<double>&,
                                       const MetalTemperatures*) const noexcept;
template Cycle<Dual<3>> Turbofan::cycle(const Intake&, const Operation&, const CycleInput<Dual<3>>&,
                                        const MetalTemperatures*) const noexcept;
template Cycle<Dual<6>> Turbofan::cycle(const Intake&, const Operation&, const CycleInput<Dual<6>>&,
                                        const MetalTemperatures*) const noexcept;
template Cycle<Dual<9>> Turbofan::cycle(const Intake&, const Operation&, const CycleInput<Dual<9>>&,
                                        const MetalTemperatures*) const noexcept;
template Cycle<GasPathDual> Turbofan::cycle(const Intake&, const OperationOf<GasPathDual>&,
                                            const CycleInput<GasPathDual>&,
                                            const MetalTemperaturesOf<GasPathDual>*) const noexcept;
template FlowDefect Turbofan::publish(const CycleInput<double>&, const Cycle<double>&, GasPath&) const noexcept;
template FlowDefect Turbofan::publish(const CycleInput<GasPathDual>&, const Cycle<GasPathDual>&,
                                      GasPathOf<GasPathDual>&) const noexcept;
template GasPath Turbofan::report(const CycleInput<double>&, const Cycle<double>&) const;
template GasPath Turbofan::report(const CycleInput<Dual<9>>&, const Cycle<Dual<9>>&) const;

}  // namespace ehm::engine_sim
