// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/parts/heat_soak.h"

#include <gtest/gtest.h>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/parts/shaft.h"
#include "engine_sim/model/solve/transient.h"

namespace ehm::engine_sim {
namespace {

constexpr FlightCondition cruise{10668.0, 0.8, 0.0};
constexpr double dt_s = 0.015;

SteadyPoint cruise_point(const Turbofan& engine) {
  return solve_steady(engine, cruise, {}, {DemandKind::n1_rpm, 3300.0});
}

Operation with_more_fuel(const SteadyPoint& start) {
  Operation operation = start.operation;
  operation.fuel_flow_kg_s *= 1.1;
  return operation;
}

double enthalpy_flow_w(const Station& s) {
  return s.w_kg_s * enthalpy(s.tt_k, s.fuel_air_ratio);
}

double shaft_power_w(double n_rpm, double n_dot_rpm_s, double inertia_kg_m2) {
  return inertia_kg_m2 * n_rpm * n_dot_rpm_s * rad_s_per_rpm * rad_s_per_rpm;
}

/// Power that enters with air and fuel and neither leaves in the jets nor speeds the spools up.
double power_left_behind_w(const EngineData& data, const GasPath& g) {
  const CombustorData& burner = data.combustor;
  const double fuel_w =
      g.fuel_flow_kg_s * (burner.efficiency * burner.lower_heating_value_j_kg + burner.fuel_enthalpy_j_kg);
  return enthalpy_flow_w(g.s2) + fuel_w - enthalpy_flow_w(g.s13) - enthalpy_flow_w(g.s50) -
         shaft_power_w(g.speeds.n1_rpm, g.n1_dot_rpm_s, data.lp_inertia_kg_m2) -
         shaft_power_w(g.speeds.n2_rpm, g.n2_dot_rpm_s, data.hp_inertia_kg_m2);
}

TEST(HeatSoak, SteadyStaysSteady) {
  const Turbofan engine(jt9d());
  const SteadyPoint start = cruise_point(engine);
  Transient run(engine, start, HeatSoak::with);
  for (int k = 0; k < 200; ++k) run.step(start.operation, dt_s);
  EXPECT_NEAR(run.speeds().n1_rpm, start.gas.speeds.n1_rpm, 1e-6);
  EXPECT_NEAR(run.speeds().n2_rpm, start.gas.speeds.n2_rpm, 1e-6);
  const std::array<double, metal_count> gas_k{start.gas.s30.tt_k, start.gas.s48.tt_k, start.gas.s50.tt_k};
  for (std::size_t i = 0; i < metal_count; ++i) EXPECT_NEAR(run.metal_k()[i], gas_k[i], 1e-6);
}

TEST(HeatSoak, WithoutItTheMetalStaysAsItIs) {
  const Turbofan engine(jt9d());
  const SteadyPoint start = cruise_point(engine);
  Transient run(engine, start);
  const MetalTemperatures before = run.metal_k();
  for (int k = 0; k < 20; ++k) run.step(with_more_fuel(start), dt_s);
  EXPECT_EQ(run.metal_k(), before);
}

TEST(HeatSoak, AfterAPowerStepT48CreepsWithTheTimeConstantsOfTheMetal) {
  const Turbofan engine(jt9d());
  const SteadyPoint start = cruise_point(engine);
  const Operation more = with_more_fuel(start);
  Transient soaked(engine, start, HeatSoak::with), plain(engine, start);
  std::vector<double> t48_k;
  for (int k = 0; k * dt_s < 400.0; ++k) {
    t48_k.push_back(soaked.output(more).s48.tt_k);
    soaked.step(more, dt_s);
    plain.step(more, dt_s);
  }
  const auto at = [&](double time_s) { return t48_k[static_cast<std::size_t>(time_s / dt_s)]; };
  const double end_k = t48_k.back();
  EXPECT_NEAR(end_k, plain.output(more).s48.tt_k, 1e-2);  // in balance the metal takes nothing
  EXPECT_GT(end_k - at(20.0), 0.5);                       // long after the spools have settled
  // C/k of jt9d.cpp: 15 s for the HPT, 30 s for the LPT; a sum of such exponentials falls by no less and no more
  const double fall = (end_k - at(20.0)) / (end_k - at(50.0));
  EXPECT_GT(fall, std::exp(30.0 / 30.0));
  EXPECT_LT(fall, std::exp(30.0 / 15.0));
}

TEST(HeatSoak, HeatThatTheGasGivesUpIsInTheMetal) {
  const Turbofan engine(jt9d());
  const SteadyPoint start = cruise_point(engine);
  const Operation more = with_more_fuel(start);
  Transient run(engine, start, HeatSoak::with);
  const auto& lumps = engine.data().metal;
  const auto stored_j = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < metal_count; ++i) sum += lumps[i].capacity_j_k * run.metal_k()[i];
    return sum;
  };
  const double before_j = stored_j();
  double given_j = 0.0, gross_w = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const GasPath g = run.output(more);
    double taken_w = 0.0;
    for (std::size_t i = 0; i < metal_count; ++i) taken_w += lumps[i].capacity_j_k * g.metal_dot_k_s[i];
    gross_w = enthalpy_flow_w(g.s50);
    EXPECT_NEAR(power_left_behind_w(engine.data(), g), taken_w, 1e-9 * gross_w);
    run.step(more, dt_s);
    given_j +=
        0.5 * dt_s * (power_left_behind_w(engine.data(), g) + power_left_behind_w(engine.data(), run.output(more)));
  }
  EXPECT_GT(given_j, 1e6);
  EXPECT_NEAR(stored_j() - before_j, given_j, 1e-4 * given_j);
}

}  // namespace
}  // namespace ehm::engine_sim
