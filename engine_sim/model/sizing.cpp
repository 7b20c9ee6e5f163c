// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/sizing.h"

#include <algorithm>
#include <cmath>

#include "engine_sim/model/thermo/static_pressure.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {
namespace {

using D = Dual<3>;

constexpr NewtonProblem<3> design_balance{
    {"T40", "HP shaft power", "LP shaft power"}, {1e-3, 1.02, 1.02}, {10.0, 12.0, 20.0}, {0.3, 0.5, 0.7}};
constexpr int most_rounds = 200;
constexpr double settled = 1e-13;

CompressorData scaled(const CompressorDesign& c) {
  const CompressorMapPoint<double> map = c.map.at(c.map_speed, c.map_r_line);
  return {
      c.map, {1.0, 1.0, (c.pressure_ratio - 1.0) / (map.pressure_ratio - 1.0), c.efficiency / map.efficiency}, c.vanes};
}

TurbineData scaled(const TurbineDesign& t) {
  return {t.map, {1.0, 1.0, 1.0, t.efficiency / t.map.at(t.map_speed, t.map_pressure_ratio).efficiency}};
}

/// All that the design says outright; capacities and corrected speeds are still one.
EngineData unsized(const EngineDesign& d) {
  return {.name = d.name,
          .inlet = d.inlet,
          .fan = scaled(d.fan),
          .lpc = scaled(d.lpc),
          .hpc = scaled(d.hpc),
          .hpc_exit_area_m2 = 1.0,
          .air = d.air,
          .combustor = d.combustor,
          .hpt = scaled(d.hpt),
          .lpt = scaled(d.lpt),
          .loss = d.loss,
          .core_nozzle = {1.0, d.core_velocity_coefficient},
          .bypass_nozzle = {1.0, d.bypass_velocity_coefficient},
          .lp_inertia_kg_m2 = d.lp_inertia_kg_m2,
          .hp_inertia_kg_m2 = d.hp_inertia_kg_m2,
          .metal = d.metal,
          .ratings = d.ratings,
          .design = {
              .flight = d.flight,
              .speeds = d.speeds,
              .fuel_flow_kg_s = 1.0,
              .unknowns = {{d.bypass_ratio, d.fan.map_r_line, d.lpc.map_r_line, d.hpc.map_r_line, 3.0, 4.0}},
          }};
}

class Sizing {
 public:
  explicit Sizing(const EngineDesign& design) : design_(design), data_(unsized(design)) {
    in_ = intake(data_.inlet, design.flight);
    operation_.flight = design.flight;
    operation_.offtake.power_w = design.power_offtake_w;
  }

  SizedEngine run() {
    guess_corrected_speeds();
    for (int round = 0; round < most_rounds; ++round) {
      change_ = 0.0;
      adapt(at_the_design_point());
      if (change_ < settled) break;
    }
    if (change_ > 1e-9) throw SolveError("residual 'design point': the size of the engine does not settle");
    operation_.fuel_flow_kg_s = data_.design.fuel_flow_kg_s;
    data_.design.offtake = operation_.offtake;
    return {data_, operation_};
  }

 private:
  static double corrected(double speed_rpm, double tt_k) {
    return speed_rpm / std::sqrt(tt_k / reference_temperature_k);
  }
  void set(double& number, double to) {
    change_ = std::max(change_, std::abs(to / number - 1.0));
    number = to;
  }

  /// From temperatures with a constant ratio of specific heats, so that the maps are read near their design points.
  void guess_corrected_speeds() {
    const auto [n1_rpm, n2_rpm] = design_.speeds;
    const auto behind = [](double tt_k, const CompressorDesign& c) {
      return tt_k * (1.0 + (std::pow(c.pressure_ratio, 1.0 / 3.5) - 1.0) / c.efficiency);
    };
    const double t21_k = behind(in_.tt_k, design_.fan), t24_k = behind(t21_k, design_.lpc);
    set(data_.fan.scale.s_nc, corrected(n1_rpm, in_.tt_k) / design_.fan.map_speed);
    set(data_.lpc.scale.s_nc, corrected(n1_rpm, t21_k) / design_.lpc.map_speed);
    set(data_.hpc.scale.s_nc, corrected(n2_rpm, t24_k) / design_.hpc.map_speed);
    const FlowUnknowns& u = data_.design.unknowns;
    place(data_.hpt, design_.hpt, n2_rpm, design_.t40_k, u.pressure_ratio_hpt);
    place(data_.lpt, design_.lpt, n1_rpm, 0.78 * design_.t40_k, u.pressure_ratio_lpt);
  }

  /// Closes T40 and both shafts by fuel flow and expansion ratios with the present scales.
  Cycle<D> at_the_design_point() {
    const Turbofan engine(data_);
    FlowUnknowns& u = data_.design.unknowns;
    const double air_kg_s =
        engine.cycle<double>(in_, operation_, {design_.speeds.n1_rpm, design_.speeds.n2_rpm, 1e-6, u}).s40.w_kg_s;
    Cycle<D> c;
    std::array<double, 3> x{data_.design.fuel_flow_kg_s / (0.02 * air_kg_s), u.pressure_ratio_hpt,
                            u.pressure_ratio_lpt};
    x[0] = std::clamp(x[0], 0.5, 2.0);
    newton(design_balance, x, [&](const std::array<D, 3>& trial) {
      CycleInput<D> input{design_.speeds.n1_rpm, design_.speeds.n2_rpm, trial[0] * (0.02 * air_kg_s), {}};
      input.unknowns = {u.bypass_ratio, u.r_line_fan, u.r_line_lpc, u.r_line_hpc, trial[1], trial[2]};
      c = engine.cycle(in_, operation_, input);
      return std::array<D, 3>{c.s40.tt_k / design_.t40_k - 1.0, 1.0 - c.hp_absorbed_power_w / c.hp_turbine_power_w,
                              1.0 - c.lp_absorbed_power_w / c.lp_turbine_power_w};
    });
    set(data_.design.fuel_flow_kg_s, x[0] * 0.02 * air_kg_s);
    u.pressure_ratio_hpt = x[1];
    u.pressure_ratio_lpt = x[2];
    return c;
  }

  void adapt(const Cycle<D>& c) {
    const auto [n1_rpm, n2_rpm] = design_.speeds;
    set(data_.lpc.scale.s_nc, corrected(n1_rpm, c.s21.tt_k.v) / design_.lpc.map_speed);
    set(data_.hpc.scale.s_nc, corrected(n2_rpm, c.s24.tt_k.v) / design_.hpc.map_speed);
    place(data_.hpt, design_.hpt, n2_rpm, c.s40.tt_k.v, data_.design.unknowns.pressure_ratio_hpt);
    place(data_.lpt, design_.lpt, n1_rpm, c.s48.tt_k.v, data_.design.unknowns.pressure_ratio_lpt);

    // a residual is 1 - capacity/flow: the capacity is to be the flow
    double* const capacities[]{&data_.lpc.scale.s_wc, &data_.hpc.scale.s_wc,      &data_.hpt.scale.s_wc,
                               &data_.lpt.scale.s_wc, &data_.core_nozzle.area_m2, &data_.bypass_nozzle.area_m2};
    for (std::size_t i = 0; i < flow_unknown_count; ++i)
      set(*capacities[i], *capacities[i] / (1.0 - c.flow_residual[i].v));
    set(data_.hpc_exit_area_m2, area_at_mach_m2(to_station(c.s30), design_.hpc_exit_mach));
    const double growth = design_.net_thrust_n / c.net_thrust_n.v;
    set(data_.fan.scale.s_wc, data_.fan.scale.s_wc * growth);
    operation_.offtake.customer_bleed_kg_s = design_.customer_bleed * c.s30.w_kg_s.v * growth;
  }

  void place(TurbineData& data, const TurbineDesign& design, double speed_rpm, double tt_k, double pressure_ratio) {
    set(data.scale.s_nc, speed_rpm / std::sqrt(tt_k * rankine_per_kelvin) / design.map_speed);
    set(data.scale.s_pr, (pressure_ratio - 1.0) / (design.map_pressure_ratio - 1.0));
  }

  const EngineDesign& design_;
  EngineData data_;
  Intake in_;
  Operation operation_;
  double change_ = 0.0;
};

}  // namespace

SizedEngine size_engine(const EngineDesign& design) {
  return Sizing(design).run();
}

}  // namespace ehm::engine_sim
