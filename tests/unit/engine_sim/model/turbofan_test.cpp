// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/turbofan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/solve/steady.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {
namespace {

constexpr FlightCondition cruise{10668.0, 0.8, 0.0};

SteadyPoint cruise_point(const Turbofan& engine) {
  return solve_steady(engine, cruise, {}, {DemandKind::fuel_flow_kg_s, 0.8172});
}

double enthalpy_flow_w(const Station& s) {
  return s.w_kg_s * enthalpy(s.tt_k, s.fuel_air_ratio);
}

TEST(Turbofan, MassAndFuelAreConserved) {
  const Turbofan engine(jt9d());
  for (const FlightCondition& flight : {cruise, FlightCondition{}, FlightCondition{6000.0, 0.5, 10.0}}) {
    const GasPath g = solve_steady(engine, flight, {}, {DemandKind::t40_k, 1250.0}).gas;
    const SecondaryAir& cooling = engine.data().air;
    EXPECT_NEAR(g.s13.w_kg_s + g.s21.w_kg_s, g.s2.w_kg_s, 1e-9 * g.s2.w_kg_s);
    EXPECT_NEAR(g.s30.w_kg_s * (1.0 - cooling.hpt_inlet - cooling.hpt_exit) + g.fuel_flow_kg_s, g.s40.w_kg_s,
                1e-9 * g.s40.w_kg_s);
    EXPECT_NEAR(g.s30.w_kg_s + g.fuel_flow_kg_s, g.s50.w_kg_s, 1e-9 * g.s50.w_kg_s);
    const double fuel_in_gas = g.s50.w_kg_s * g.s50.fuel_air_ratio / (1.0 + g.s50.fuel_air_ratio);
    EXPECT_NEAR(fuel_in_gas, g.fuel_flow_kg_s, 1e-9 * g.fuel_flow_kg_s);
    EXPECT_NEAR(g.s13.w_kg_s / g.s21.w_kg_s, g.bypass_ratio, 1e-9 * g.bypass_ratio);
  }
}

TEST(Turbofan, EnergyThatEntersLeavesInTheJets) {
  const Turbofan engine(jt9d());
  const GasPath g = cruise_point(engine).gas;
  const CombustorData& burner = engine.data().combustor;
  const double fuel_w =
      g.fuel_flow_kg_s * (burner.efficiency * burner.lower_heating_value_j_kg + burner.fuel_enthalpy_j_kg);
  const double in_w = enthalpy_flow_w(g.s2) + fuel_w;
  const double out_w = enthalpy_flow_w(g.s13) + enthalpy_flow_w(g.s50);
  EXPECT_NEAR(out_w, in_w, 1e-9 * in_w);  // steady: both shafts pass on what they get
}

TEST(Turbofan, ShaftPowersBalanceAndGiveTheAccelerationOtherwise) {
  const Turbofan engine(jt9d());
  const SteadyPoint at = cruise_point(engine);
  const double hpc_power_w = enthalpy_flow_w(at.gas.s30) - enthalpy_flow_w(at.gas.s24);
  const double omega = at.gas.speeds.n2_rpm * rad_s_per_rpm;
  const double surplus_w = at.gas.n2_dot_rpm_s * rad_s_per_rpm * omega * engine.data().hp_inertia_kg_m2;
  EXPECT_LT(std::abs(surplus_w), 1e-9 * hpc_power_w);

  Operation more = at.operation;
  more.fuel_flow_kg_s *= 1.05;
  FlowUnknowns unknowns = at.unknowns;
  const GasPath g = engine.gas_path(more, at.gas.speeds, unknowns);
  const double power_w =
      enthalpy_flow_w(g.s40) - enthalpy_flow_w(g.s48) + 0.09 * enthalpy_flow_w(g.s30) -
      (enthalpy_flow_w(g.s30) - enthalpy_flow_w(g.s24));  // 0.09: cooling air joins before station 48
  EXPECT_NEAR(g.n2_dot_rpm_s * rad_s_per_rpm * omega * engine.data().hp_inertia_kg_m2, power_w, 1e-9 * hpc_power_w);
  EXPECT_GT(g.n1_dot_rpm_s, 0.0);
}

TEST(Turbofan, JacobianIsThatOfCentralDifferences) {
  const Turbofan engine(jt9d());
  const SteadyPoint at = cruise_point(engine);
  const Intake in = intake(engine.data().inlet, cruise);
  Operation worn = at.operation;
  worn.health = {-0.01, 0.01, -0.02, 0.0, -0.01, -0.02, -0.03, 0.01, 0.0, 0.02};
  const std::array<double, flow_unknown_count> x = pack(at.unknowns);
  std::array<Dual<6>, 6> seeded;
  for (std::size_t i = 0; i < 6; ++i) seeded[i] = Dual<6>::variable(x[i], i);
  const auto exact = engine.cycle<Dual<6>>(
      in, worn, {at.gas.speeds.n1_rpm, at.gas.speeds.n2_rpm, at.gas.fuel_flow_kg_s, unpack(seeded)});
  for (std::size_t j = 0; j < 6; ++j) {
    const double step = 1e-5;
    const auto shifted = [&](double by) {
      std::array<double, 6> moved = x;
      moved[j] += by;
      return engine
          .cycle<double>(in, worn, {at.gas.speeds.n1_rpm, at.gas.speeds.n2_rpm, at.gas.fuel_flow_kg_s, unpack(moved)})
          .flow_residual;
    };
    const auto above = shifted(step), below = shifted(-step);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(exact.flow_residual[i].d[j], (above[i] - below[i]) / (2.0 * step), 1e-7)
          << flow_balance_names[i] << " by unknown " << j;
    }
  }
}

TEST(Turbofan, ExitAreaOfTheCompressorGivesMach03AtTheDesignPoint) {
  // NPSS case 1: W 245.29 lbm/s, Pt 297.13 psia, Tt 1398.61 R, Ps 279.660 psia at station 3
  const GasPath g = solve_steady(Turbofan(jt9d()), jt9d().design.flight, {},
                                 {DemandKind::fuel_flow_kg_s, jt9d().design.fuel_flow_kg_s})
                        .gas;
  EXPECT_NEAR(g.ps_30_pa / g.s30.pt_pa, 279.660 / 297.130, 2e-4);
}

TEST(Turbofan, RefusesInputThatMeansNothing) {
  const Turbofan engine(jt9d());
  const SteadyPoint at = cruise_point(engine);
  FlowUnknowns unknowns = at.unknowns;
  Operation bad = at.operation;
  bad.fuel_flow_kg_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(engine.gas_path(bad, at.gas.speeds, unknowns), std::invalid_argument);
  bad = at.operation;
  bad.health[hpc_flow] = -2.0;
  try {
    engine.gas_path(bad, at.gas.speeds, unknowns);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("hpc_flow"));
  }
  EXPECT_THROW(engine.gas_path(at.operation, {0.0, 7000.0}, unknowns), std::invalid_argument);
  bad = at.operation;
  bad.flight.mach = 1.2;
  EXPECT_THROW(engine.gas_path(bad, at.gas.speeds, unknowns), std::out_of_range);
}

TEST(Turbofan, NamesTheBalanceThatCannotClose) {
  const Turbofan engine(jt9d());
  const SteadyPoint at = cruise_point(engine);
  FlowUnknowns unknowns = at.unknowns;
  try {
    engine.gas_path(at.operation, {9000.0, 3000.0}, unknowns);  // a fan at 2.4 times its speed
    FAIL();
  } catch (const SolveError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("residual '"));
  }
}

}  // namespace
}  // namespace ehm::engine_sim
