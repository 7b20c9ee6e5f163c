#include "engine_sim/model/turbofan.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "engine_sim/model/bleed.h"
#include "engine_sim/model/combustor.h"
#include "engine_sim/model/duct.h"
#include "engine_sim/model/shaft.h"
#include "engine_sim/model/static_pressure.h"

namespace ehm::engine {
namespace {

constexpr NewtonProblem<flow_unknown_count> flow_balance{flow_balance_names, flow_unknown_box::lower,
                                                         flow_unknown_box::upper, flow_unknown_box::largest_step};

void require(bool ok, const std::string& key, double value, const char* range) {
  if (!ok) throw std::invalid_argument("engine: " + key + " = " + std::to_string(value) + " is outside " + range);
}

void require_open_nozzle(const char* name, double pressure_ratio) {
  if (pressure_ratio > 1.0005) return;
  throw SolveError(std::string("residual '") + name + " nozzle flow': pressure ratio " +
                   std::to_string(pressure_ratio) +
                   " drives no jet (windmilling is not modelled); give more fuel flow");
}

template <class S>
S closure(const S& flow, const S& capacity) {
  return 1.0 - capacity / flow;
}

}  // namespace

void require_valid(const Operation& operation) {
  const double wf = operation.fuel_flow_kg_s;
  require(std::isfinite(wf) && wf > 0.0, "fuel_flow_kg_s", wf, "0 < value < infinity (windmilling is not modelled)");
  for (std::size_t i = 0; i < health_count; ++i) {
    const double h = operation.health[i];
    require(h >= -0.5 && h <= 0.5, "health " + std::string(health_names[i]), h, "-0.5 to 0.5");
  }
}

//  ambient -> inlet -2- fan -+-13- bypass duct -15-> bypass nozzle
//                            +-21- duct -22- LPC -24- duct -25- HPC -30- bleeds -36- combustor -40-
//  -40- HPT (+ cooling) -45- duct -48- LPT -50- duct -7-> core nozzle
template <class S>
Cycle<S> Turbofan::cycle(const Intake& in, const HealthVector& h, const CycleInput<S>& input) const {
  const FlowUnknownsOf<S>& x = input.unknowns;
  const ComponentHealth fan_health{h[fan_efficiency], h[fan_flow]}, lpc_health{h[lpc_efficiency], h[lpc_flow]},
      hpc_health{h[hpc_efficiency], h[hpc_flow]}, hpt_health{h[hpt_efficiency], h[hpt_flow]},
      lpt_health{h[lpt_efficiency], h[lpt_flow]};
  Cycle<S> c;

  // fan: its map defines the flow of the engine; core and bypass leave it in the same state
  const S pt2 = S(in.fan_face_pt_pa), tt2 = S(in.tt_k);
  const auto fan_map = read_map(data_.fan, pt2, tt2, input.n1_rpm, x.r_line_fan, fan_health);
  c.s2 = make_stream(fan_map.flow_capacity_kg_s, pt2, tt2, S(0.0));
  c.fan = compress(data_.fan, c.s2, fan_map, fan_health);
  c.s21 = with_flow(c.fan.exit, S(c.s2.w_kg_s / (1.0 + x.bypass_ratio)));
  c.s13 = with_flow(c.fan.exit, S(c.s2.w_kg_s - c.s21.w_kg_s));

  const Stream<S> s15 = duct(c.s13, data_.loss.bypass);
  const auto bypass = exhaust(data_.bypass_nozzle, s15, in.ambient_p_pa);

  const Stream<S> s22 = duct(c.s21, data_.loss.fan_to_lpc);
  const auto lpc_map = read_map(data_.lpc, s22.pt_pa, s22.tt_k, input.n1_rpm, x.r_line_lpc, lpc_health);
  c.lpc = compress(data_.lpc, s22, lpc_map, lpc_health);
  c.s24 = c.lpc.exit;

  const Stream<S> s25 = duct(c.s24, data_.loss.lpc_to_hpc);
  const auto hpc_map = read_map(data_.hpc, s25.pt_pa, s25.tt_k, input.n2_rpm, x.r_line_hpc, hpc_health);
  c.hpc = compress(data_.hpc, s25, hpc_map, hpc_health);
  c.s30 = c.hpc.exit;

  const Bleeds<S> bleeds = bleed_off(c.s30, data_.cooling);
  c.s40 = burn(data_.combustor, bleeds.main, input.fuel_flow_kg_s);

  const auto hpt =
      expand(data_.hpt, c.s40, mix(c.s40, bleeds.to_hpt_inlet), input.n2_rpm, x.pressure_ratio_hpt, hpt_health);
  const Stream<S> s45 = mix(hpt.exit, bleeds.to_hpt_exit);
  c.s48 = duct(s45, data_.loss.hpt_to_lpt);

  const auto lpt = expand(data_.lpt, c.s48, c.s48, input.n1_rpm, x.pressure_ratio_lpt, lpt_health);
  c.s50 = lpt.exit;
  const Stream<S> s7 = duct(c.s50, data_.loss.lpt_to_nozzle);
  const auto core = exhaust(data_.core_nozzle, s7, in.ambient_p_pa);

  c.hp_turbine_power_w = hpt.power_w;
  c.hp_absorbed_power_w = c.hpc.power_w;
  c.lp_turbine_power_w = lpt.power_w;
  c.lp_absorbed_power_w = c.fan.power_w + c.lpc.power_w;
  c.gross_thrust_n = core.gross_thrust_n + bypass.gross_thrust_n;
  c.net_thrust_n = c.gross_thrust_n - c.s2.w_kg_s * in.flight_speed_m_s;
  c.core_nozzle_pressure_ratio = s7.pt_pa / in.ambient_p_pa;
  c.bypass_nozzle_pressure_ratio = s15.pt_pa / in.ambient_p_pa;
  c.flow_residual = {closure(s22.w_kg_s, c.lpc.flow_capacity_kg_s), closure(s25.w_kg_s, c.hpc.flow_capacity_kg_s),
                     closure(c.s40.w_kg_s, hpt.flow_capacity_kg_s), closure(c.s48.w_kg_s, lpt.flow_capacity_kg_s),
                     closure(s7.w_kg_s, core.flow_capacity_kg_s),   closure(s15.w_kg_s, bypass.flow_capacity_kg_s)};
  return c;
}

template <class S>
GasPath Turbofan::report(const CycleInput<S>& input, const Cycle<S>& c) const {
  require_open_nozzle("core", value(c.core_nozzle_pressure_ratio));
  require_open_nozzle("bypass", value(c.bypass_nozzle_pressure_ratio));
  GasPath g;
  g.s2 = to_station(c.s2);
  g.s13 = to_station(c.s13);
  g.s21 = to_station(c.s21);
  g.s24 = to_station(c.s24);
  g.s30 = to_station(c.s30);
  g.s40 = to_station(c.s40);
  g.s48 = to_station(c.s48);
  g.s50 = to_station(c.s50);
  g.ps_30_pa = static_pressure_pa(g.s30, data_.hpc_exit_area_m2);
  g.speeds = {value(input.n1_rpm), value(input.n2_rpm)};
  g.n1_dot_rpm_s = shaft_acceleration_rpm_s(value(c.lp_turbine_power_w) - value(c.lp_absorbed_power_w), g.speeds.n1_rpm,
                                            data_.lp_inertia_kg_m2);
  g.n2_dot_rpm_s = shaft_acceleration_rpm_s(value(c.hp_turbine_power_w) - value(c.hp_absorbed_power_w), g.speeds.n2_rpm,
                                            data_.hp_inertia_kg_m2);
  g.fuel_flow_kg_s = value(input.fuel_flow_kg_s);
  g.net_thrust_n = value(c.net_thrust_n);
  g.gross_thrust_n = value(c.gross_thrust_n);
  g.bypass_ratio = value(input.unknowns.bypass_ratio);
  g.overall_pressure_ratio = g.s30.pt_pa / g.s2.pt_pa;
  g.stall_margin_fan_percent = stall_margin_percent(data_.fan, c.fan);
  g.stall_margin_lpc_percent = stall_margin_percent(data_.lpc, c.lpc);
  g.stall_margin_hpc_percent = stall_margin_percent(data_.hpc, c.hpc);
  return g;
}

GasPath Turbofan::gas_path(const Operation& operation, const SpoolSpeeds& speeds, FlowUnknowns& unknowns) const {
  require_valid(operation);
  require(speeds.n1_rpm > 0.0 && std::isfinite(speeds.n1_rpm), "n1_rpm", speeds.n1_rpm, "0 < value < infinity");
  require(speeds.n2_rpm > 0.0 && std::isfinite(speeds.n2_rpm), "n2_rpm", speeds.n2_rpm, "0 < value < infinity");
  const Intake in = intake(data_.inlet, operation.flight);

  using D = Dual<flow_unknown_count>;
  CycleInput<D> input{speeds.n1_rpm, speeds.n2_rpm, operation.fuel_flow_kg_s, {}};
  Cycle<D> last;
  std::array<double, flow_unknown_count> x = pack(unknowns);
  newton(flow_balance, x, [&](const std::array<D, flow_unknown_count>& trial) {
    input.unknowns = unpack(trial);
    last = cycle(in, operation.health, input);
    return last.flow_residual;
  });
  unknowns = {unpack(x)};
  return report(input, last);
}

template Cycle<double> Turbofan::cycle(const Intake&, const HealthVector&, const CycleInput<double>&) const;
template Cycle<Dual<6>> Turbofan::cycle(const Intake&, const HealthVector&, const CycleInput<Dual<6>>&) const;
template Cycle<Dual<9>> Turbofan::cycle(const Intake&, const HealthVector&, const CycleInput<Dual<9>>&) const;
template GasPath Turbofan::report(const CycleInput<double>&, const Cycle<double>&) const;
template GasPath Turbofan::report(const CycleInput<Dual<9>>&, const Cycle<Dual<9>>&) const;

}  // namespace ehm::engine
