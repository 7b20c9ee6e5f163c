// SPDX-License-Identifier: Apache-2.0
// Cold starts over the whole envelope, and the conservation laws at every point that they find.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/ratings.h"
#include "engine_sim/model/sizing.h"
#include "engine_sim/model/solve/steady.h"
#include "envelope.h"
#include "high_bypass_engine.h"

namespace ehm::engine_sim {
namespace {

double enthalpy_flow_w(const Station& s, double w_kg_s) {
  return w_kg_s * enthalpy(s.tt_k, s.fuel_air_ratio);
}
double enthalpy_flow_w(const Station& s) {
  return enthalpy_flow_w(s, s.w_kg_s);
}

/// Relative errors of the balances, from the published stations only.
struct Balances {
  double mass, fuel, energy, lp_power, hp_power;
  double worst() const {
    return std::max({std::abs(mass), std::abs(fuel), std::abs(energy), std::abs(lp_power), std::abs(hp_power)});
  }
};

Balances balances(const EngineData& data, const SteadyPoint& point) {
  const GasPath& g = point.gas;
  const SecondaryAir& air = data.air;
  const auto& [bleed_kg_s, offtake_w] = point.operation.offtake;
  const double vbv_kg_s = point.operation.geometry.vbv_fraction * g.s24.w_kg_s;
  const double hpt_cooling_kg_s = (air.hpt_inlet + air.hpt_exit) * g.s30.w_kg_s;
  const double lpt_cooling_kg_s = (air.lpt_inlet + air.lpt_exit) * g.s30.w_kg_s;
  // a port passes air at the share of the HPC's work that has been done there
  const auto port_w = [&](double work, double w_kg_s) {
    return std::lerp(enthalpy_flow_w(g.s24, w_kg_s), enthalpy_flow_w(g.s30, w_kg_s), work);
  };
  const double lpt_port_w = port_w(air.lpt_port_work, lpt_cooling_kg_s);
  const double customer_w = port_w(air.customer_port_work, bleed_kg_s);
  const double to_the_exit_kg_s = g.s30.w_kg_s - lpt_cooling_kg_s - bleed_kg_s;
  const double fuel_w = g.fuel_flow_kg_s * (data.combustor.efficiency * data.combustor.lower_heating_value_j_kg +
                                            data.combustor.fuel_enthalpy_j_kg);

  const double mass_in = g.s2.w_kg_s + g.fuel_flow_kg_s;
  const double mass_out = g.s13.w_kg_s + vbv_kg_s + bleed_kg_s + g.s50.w_kg_s;
  const double fuel_out = g.s50.w_kg_s * g.s50.fuel_air_ratio / (1.0 + g.s50.fuel_air_ratio);
  const double energy_in = enthalpy_flow_w(g.s2) + fuel_w;
  const double energy_out =
      enthalpy_flow_w(g.s13) + enthalpy_flow_w(g.s24, vbv_kg_s) + customer_w + enthalpy_flow_w(g.s50) + offtake_w;
  const double lpt_w = enthalpy_flow_w(g.s48) + lpt_port_w - enthalpy_flow_w(g.s50);
  const double lp_absorbed_w = enthalpy_flow_w(g.s13) + enthalpy_flow_w(g.s24) - enthalpy_flow_w(g.s2);
  const double hpt_w = enthalpy_flow_w(g.s40) + enthalpy_flow_w(g.s30, hpt_cooling_kg_s) - enthalpy_flow_w(g.s48);
  const double hp_absorbed_w = enthalpy_flow_w(g.s30, to_the_exit_kg_s) + lpt_port_w + customer_w -
                               enthalpy_flow_w(g.s24, g.s30.w_kg_s) + offtake_w;
  return {mass_out / mass_in - 1.0, fuel_out / g.fuel_flow_kg_s - 1.0, energy_out / energy_in - 1.0,
          lp_absorbed_w / lpt_w - 1.0, hp_absorbed_w / hpt_w - 1.0};
}

TEST(Envelope, ColdStartsConvergeFromIdleToMaximumAndConserve) {
  const Turbofan engine(jt9d());
  const char* const seed = std::getenv("EHM_ENVELOPE_SEED");  // other points than those of every run
  envelope::Points points(seed ? std::strtoull(seed, nullptr, 10) : 20261122);
  constexpr int count = 20000;
  int solved = 0, failures = 0;
  long iterations = 0;
  double worst_balance = 0.0;
  for (int i = 0; i < count; ++i) {
    const FlightCondition flight = points.flight();
    const HealthVector health = points.health();
    const double share = points.uniform(0.0, 1.0);
    const auto cold = [&](const Demand& demand) {
      const SteadyPoint p = solve_steady(engine, flight, health, demand);
      iterations += p.iterations;
      worst_balance = std::max(worst_balance, balances(engine.data(), p).worst());
      ++solved;
      return p.gas;
    };
    try {
      const double tt2_k = intake(engine.data().inlet, flight).tt_k;
      const GasPath maximum = cold({DemandKind::limit_ratio, 1.0});
      const GasPath idle = cold({DemandKind::n2_rpm, idle_n2_rpm(engine.data().ratings, flight, tt2_k)});
      EXPECT_LT(idle.fuel_flow_kg_s, maximum.fuel_flow_kg_s);
      const double fuel_flow_kg_s = std::lerp(idle.fuel_flow_kg_s, maximum.fuel_flow_kg_s, share);
      const GasPath between = cold({DemandKind::fuel_flow_kg_s, fuel_flow_kg_s});
      // found again by what it gives
      EXPECT_NEAR(cold({DemandKind::t40_k, between.s40.tt_k}).speeds.n1_rpm, between.speeds.n1_rpm, 1e-3);
      EXPECT_NEAR(cold({DemandKind::net_thrust_n, between.net_thrust_n}).speeds.n1_rpm, between.speeds.n1_rpm, 1e-3);
    } catch (const SolveError& e) {
      ++failures;
      ADD_FAILURE() << "point " << i << ", " << flight.altitude_m << " m, M " << flight.mach << ", ISA "
                    << flight.delta_isa_k << " K: " << e.what();
    }
  }
  std::printf("cold starts: %d points, %d solutions, %d failures, %.1f iterations a solution; worst balance %.1e\n",
              count, solved, failures, static_cast<double>(iterations) / solved, worst_balance);
  EXPECT_LT(worst_balance, 1e-9);
}

TEST(Envelope, VariableGeometryAndOfftakeConserve) {
  const Turbofan engine(jt9d());
  envelope::Points points(7);
  double worst_balance = 0.0;
  for (int i = 0; i < 2000; ++i) {
    Operation operation{.flight = points.flight(), .health = points.health()};
    operation.geometry = {points.uniform(-5.0, 10.0), points.uniform(0.0, 0.2), points.uniform(0.95, 1.1)};
    const SteadyPoint plain = solve_steady(engine, operation, {DemandKind::limit_ratio, 0.95});
    operation.offtake = {points.uniform(0.0, 0.05) * plain.gas.s30.w_kg_s, points.uniform(0.0, 0.01) * 30e6};
    const SteadyPoint p = solve_steady(engine, operation, {DemandKind::limit_ratio, 0.95});
    worst_balance =
        std::max({worst_balance, balances(engine.data(), plain).worst(), balances(engine.data(), p).worst()});
  }
  std::printf("geometry and off-take: worst balance %.1e\n", worst_balance);
  EXPECT_LT(worst_balance, 1e-9);
}

TEST(Envelope, TheSecondEnginesPortsAndLeaksConserve) {
  const SizedEngine sized = size_engine(high_bypass_design());
  const Turbofan engine(sized.data);
  double worst_balance = 0.0;
  for (const double t40_k : {1300.0, 1450.0, 1587.2}) {
    const SteadyPoint p = solve_steady(engine, sized.design, {DemandKind::t40_k, t40_k});
    worst_balance = std::max(worst_balance, balances(sized.data, p).worst());
  }
  std::printf("interstage ports, bypass leak: worst balance %.1e\n", worst_balance);
  EXPECT_LT(worst_balance, 1e-9);
}

// A search that has left the gas data would otherwise end on a flame of 15 000 K with no air.
TEST(Envelope, NoPointWithoutAirOrBeyondTheGasData) {
  const Turbofan engine(jt9d());
  const Operation starved{.flight = {12577.0, 0.31, 31.0}, .offtake = {4.2, 266e3}};
  EXPECT_THROW(solve_steady(engine, starved, {DemandKind::n1_rpm, 1200.0}), SolveError);
  EXPECT_THROW(solve_steady(engine, {0.0, 0.0, 0.0}, {}, {DemandKind::t40_k, 2500.0}), SolveError);
}

TEST(Envelope, RatingsMeetTheirDefinitions) {
  const Turbofan engine(jt9d());
  const Ratings& r = engine.data().ratings;
  const GasPath hot = solve_steady(engine, {0.0, 0.0, 35.0}, {}, {DemandKind::limit_ratio, 1.0}).gas;
  EXPECT_NEAR(hot.s40.tt_k, r.t40_max_k, 1e-6);  // a hot day: T40 limits
  const FlightCondition cold_high{13500.0, 0.85, -20.0};
  const GasPath cold = solve_steady(engine, cold_high, {}, {DemandKind::limit_ratio, 1.0}).gas;
  EXPECT_NEAR(cold.speeds.n1_rpm / std::sqrt(cold.s2.tt_k / reference_temperature_k), r.corrected_n1_max_rpm, 1e-6);
  EXPECT_LT(cold.s40.tt_k, r.t40_max_k);
  EXPECT_TRUE(on_ground({0.0, 0.2, 0.0}));
  EXPECT_FALSE(on_ground({10668.0, 0.2, 0.0}));
}

}  // namespace
}  // namespace ehm::engine_sim
