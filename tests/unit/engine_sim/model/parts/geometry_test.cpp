// SPDX-License-Identifier: Apache-2.0
// What actuators, bleed and off-take do to the engine, and where the model ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim {
namespace {

constexpr FlightCondition cruise{10668.0, 0.8, 0.0};

class Geometries : public testing::Test {
 protected:
  GasPath at(const Geometry& geometry, const Offtake& offtake = {}, double fuel_flow_kg_s = 0.7) const {
    Operation operation{.flight = cruise};
    operation.geometry = geometry;
    operation.offtake = offtake;
    return solve_steady(engine_, operation, {DemandKind::fuel_flow_kg_s, fuel_flow_kg_s}).gas;
  }
  Turbofan engine_{jt9d()};
  GasPath nominal_ = at({});
};

TEST_F(Geometries, ZeroOfEverythingIsTheEngineWithoutIt) {
  const GasPath plain = solve_steady(engine_, cruise, {}, {DemandKind::fuel_flow_kg_s, 0.7}).gas;
  EXPECT_EQ(plain.net_thrust_n, nominal_.net_thrust_n);
  EXPECT_EQ(plain.s24.w_kg_s, plain.s30.w_kg_s);
}

TEST_F(Geometries, ClosingTheVanesActsAsLostFlowCapacityAtOneRate) {
  const GasPath closed = at({.vsv_deg = 2.0});
  EXPECT_GT(closed.speeds.n2_rpm, nominal_.speeds.n2_rpm);  // the core turns faster to pass its flow
  EXPECT_LT(at({.vsv_deg = -2.0}).speeds.n2_rpm, nominal_.speeds.n2_rpm);
  // a degree is one percent of flow (VaneData): N2 moves about as for two percent of lost HPC flow
  HealthVector worn{};
  worn[hpc_flow] = -0.02;
  const GasPath lost = solve_steady(engine_, cruise, worn, {DemandKind::fuel_flow_kg_s, 0.7}).gas;
  const double moved = closed.speeds.n2_rpm - nominal_.speeds.n2_rpm;
  EXPECT_NEAR(moved, lost.speeds.n2_rpm - nominal_.speeds.n2_rpm, 0.5 * moved);
}

TEST_F(Geometries, BleedValvesUnloadTheLpcAndCostThrust) {
  const GasPath open = at({.vbv_fraction = 0.1});
  EXPECT_GT(open.stall_margin_lpc_percent, nominal_.stall_margin_lpc_percent + 1.0);
  EXPECT_NEAR(open.s30.w_kg_s, 0.9 * open.s24.w_kg_s, 1e-9 * open.s24.w_kg_s);
  EXPECT_LT(open.net_thrust_n, nominal_.net_thrust_n);
}

TEST_F(Geometries, CustomerBleedAndPowerHeatTheTurbine) {
  const GasPath bled = at({}, {.customer_bleed_kg_s = 1.0}), loaded = at({}, {.power_w = 200e3});
  const auto at_n1 = [&](const Offtake& offtake) {
    Operation operation{.flight = cruise};
    operation.offtake = offtake;
    return solve_steady(engine_, operation, {DemandKind::n1_rpm, nominal_.speeds.n1_rpm}).gas;
  };
  EXPECT_GT(at_n1({.customer_bleed_kg_s = 1.0}).s40.tt_k, nominal_.s40.tt_k + 1.0);
  EXPECT_GT(at_n1({.power_w = 200e3}).s40.tt_k, nominal_.s40.tt_k + 1.0);
  EXPECT_LT(bled.net_thrust_n, nominal_.net_thrust_n);
  EXPECT_LT(loaded.net_thrust_n, nominal_.net_thrust_n);
  EXPECT_NEAR(bled.s40.w_kg_s, bled.s30.w_kg_s * (1.0 - 0.055 - 0.035) - 1.0 + bled.fuel_flow_kg_s, 1e-9);
}

TEST_F(Geometries, AWiderCoreNozzleUnloadsTheTurbineExit) {
  const GasPath wide = at({.core_nozzle_area_ratio = 1.1}), narrow = at({.core_nozzle_area_ratio = 0.9});
  EXPECT_LT(wide.s50.pt_pa, nominal_.s50.pt_pa);
  EXPECT_GT(narrow.s50.pt_pa, nominal_.s50.pt_pa);
  EXPECT_GT(wide.speeds.n1_rpm, narrow.speeds.n1_rpm);  // a larger expansion ratio drives the fan
}

TEST_F(Geometries, TheCruiseBypassNozzleChokesAndTheIdleOneDoesNot) {
  // critical pressure ratio of air 1.89
  const auto bypass_ratio_of_pressures = [&](const GasPath& g) {
    return g.s13.pt_pa * (1.0 - engine_.data().loss.bypass) / intake(engine_.data().inlet, cruise).ambient_p_pa;
  };
  EXPECT_GT(bypass_ratio_of_pressures(nominal_), 1.9);
  EXPECT_LT(bypass_ratio_of_pressures(at({}, {}, 0.1)), 1.9);
}

TEST_F(Geometries, WindmillingIsRefusedAndSaid) {
  Operation unlit{.flight = cruise};
  FlowUnknowns unknowns = engine_.data().design.unknowns;
  try {
    engine_.gas_path(unlit, nominal_.speeds, unknowns);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("windmilling is not modelled"));
  }
}

TEST_F(Geometries, RefusesPositionsOutOfRange) {
  const auto refused = [&](const Geometry& geometry, const Offtake& offtake, const char* key) {
    try {
      at(geometry, offtake);
      ADD_FAILURE() << key;
    } catch (const std::invalid_argument& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(key));
    }
  };
  refused({.vsv_deg = 60.0}, {}, "vsv_deg");
  refused({.vbv_fraction = -0.1}, {}, "vbv_fraction");
  refused({.vbv_fraction = std::numeric_limits<double>::quiet_NaN()}, {}, "vbv_fraction");
  refused({.core_nozzle_area_ratio = 0.0}, {}, "core_nozzle_area_ratio");
  refused({}, {.customer_bleed_kg_s = -1.0}, "customer_bleed_kg_s");
  refused({}, {.power_w = 1e9}, "power_offtake_w");
}

}  // namespace
}  // namespace ehm::engine_sim
