// SPDX-License-Identifier: Apache-2.0
// Engines from their design points: pyCycle's high-bypass turbofan, and the JT9D again from the inputs of its model.
#include "engine_sim/model/sizing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/solve/steady.h"
#include "engine_sim/model/solve/transient.h"
#include "engine_sim/model/units.h"
#include "high_bypass_engine.h"

namespace ehm::engine_sim {
namespace {

/// The sized engine flown at its design point.
GasPath at_design(const SizedEngine& sized) {
  return solve_steady(Turbofan(sized.data), sized.design, {DemandKind::fuel_flow_kg_s, sized.design.fuel_flow_kg_s})
      .gas;
}

TEST(Sizing, TheSizedEngineRunsAtItsDesignPoint) {
  const EngineDesign design = high_bypass_design();
  const SizedEngine sized = size_engine(design);
  const SteadyPoint p = solve_steady(Turbofan(sized.data), sized.design, {DemandKind::t40_k, design.t40_k});
  EXPECT_LE(p.iterations, 2);
  EXPECT_NEAR(p.gas.net_thrust_n, design.net_thrust_n, 1e-8 * design.net_thrust_n);
  EXPECT_NEAR(p.gas.speeds.n1_rpm, design.speeds.n1_rpm, 1e-8 * design.speeds.n1_rpm);
  EXPECT_NEAR(p.gas.speeds.n2_rpm, design.speeds.n2_rpm, 1e-8 * design.speeds.n2_rpm);
  EXPECT_NEAR(p.gas.bypass_ratio, design.bypass_ratio, 1e-8);
  EXPECT_NEAR(p.gas.s24.pt_pa / (p.gas.s21.pt_pa * (1.0 - design.loss.fan_to_lpc)), design.lpc.pressure_ratio, 1e-8);
}

// Expected: pyCycle's own results for this point.
TEST(Sizing, HighBypassDesignPointWithinOnePercentOfPyCycle) {
  const SizedEngine sized = size_engine(high_bypass_design());
  const GasPath g = at_design(sized);
  const FlowUnknowns& u = sized.data.design.unknowns;
  const double burner_air_kg_s = g.s40.w_kg_s - g.fuel_flow_kg_s;
  const struct {
    const char* name;
    double ours, published;
  } rows[]{{"inlet flow, lbm/s", g.s2.w_kg_s / kg_per_lbm, 344.303},
           {"overall pressure ratio", g.overall_pressure_ratio, 30.094},
           {"fuel-air ratio", g.fuel_flow_kg_s / burner_air_kg_s, 0.02491989},
           {"Tt3, R", g.s30.tt_k * rankine_per_kelvin, 1276.476},
           {"HPT expansion ratio", u.pressure_ratio_hpt, 3.61475},
           {"LPT expansion ratio", u.pressure_ratio_lpt, 4.36563},
           {"gross thrust, lbf", g.gross_thrust_n / n_per_lbf, 14232.2},
           {"net thrust, lbf", g.net_thrust_n / n_per_lbf, 5900.0},
           {"TSFC, lbm/(lbf h)", g.fuel_flow_kg_s / kg_per_lbm * 3600.0 / (g.net_thrust_n / n_per_lbf), 0.63072}};
  for (const auto& row : rows) {
    const double percent = 100.0 * (row.ours / row.published - 1.0);
    std::printf("%-24s %12.5f %12.5f %+7.3f %%\n", row.name, row.ours, row.published, percent);
    EXPECT_LT(std::abs(percent), 1.0) << row.name;
  }
}

TEST(Sizing, TheSecondEngineRunsOffDesignAndInTransients) {
  const SizedEngine sized = size_engine(high_bypass_design());
  const Turbofan engine(sized.data);
  const SteadyPoint take_off = solve_steady(engine, {0.0, 0.0, 15.0}, {}, {DemandKind::limit_ratio, 1.0});
  EXPECT_GT(take_off.gas.net_thrust_n, 3.0 * 5900.0 * n_per_lbf);
  HealthVector worn{};
  worn[hpc_efficiency] = -0.03;
  const SteadyPoint cruise = solve_steady(engine, sized.design, {DemandKind::n1_rpm, 4500.0});
  Operation worn_cruise = sized.design;
  worn_cruise.health = worn;
  EXPECT_GT(solve_steady(engine, worn_cruise, {DemandKind::n1_rpm, 4500.0}).gas.s40.tt_k, cruise.gas.s40.tt_k);
  Transient run(engine, cruise);
  Operation more = cruise.operation;
  more.fuel_flow_kg_s *= 1.05;
  for (int k = 0; k < 200; ++k) run.step(more, 0.015);
  EXPECT_GT(run.speeds().n1_rpm, 4510.0);
}

// JT9D.mdl's design inputs, with the map coordinates of NPSS case 1, give the scale factors and areas that its own
// engine file lists, which NPSS made from the same inputs.
TEST(Sizing, TheJt9dsDesignInputsGiveItsMapScales) {
  const EngineData& listed = jt9d();
  const EngineDesign design{.name = "JT9D",
                            .flight = {0.0, 0.0, 15.0},
                            .net_thrust_n = 49885.7 * n_per_lbf,
                            .t40_k = 2730.0 / rankine_per_kelvin,
                            .bypass_ratio = 5.27511,
                            .speeds = {3750.0, 8000.0},
                            .inlet = listed.inlet,
                            .fan = {listed.fan.map, 1.60306, 0.90380, {}, 0.927, 2.0},
                            .lpc = {listed.lpc.map, 2.25, 0.86575, {}, 0.927, 1.7688},
                            .hpc = {listed.hpc.map, 5.67905, 0.862469, {}, 1.0, 2.0805},
                            .hpt = {listed.hpt.map, 0.91445 * 0.9979, 100.0, 5.0},
                            .lpt = {listed.lpt.map, 0.92880, 100.0, 6.0},
                            .air = listed.air,
                            .combustor = listed.combustor,
                            .loss = listed.loss,
                            .core_velocity_coefficient = 0.9999,
                            .bypass_velocity_coefficient = 0.9975,
                            .lp_inertia_kg_m2 = 1.0,
                            .hp_inertia_kg_m2 = 1.0,
                            .metal = listed.metal,
                            .ratings = listed.ratings};
  const EngineData sized = size_engine(design).data;
  const auto near = [](const char* name, double ours, double theirs) { EXPECT_NEAR(ours / theirs, 1.0, 5e-3) << name; };
  const auto near_scale = [&](const char* name, const MapScale& ours, const MapScale& theirs) {
    near(name, ours.s_nc, theirs.s_nc);
    near(name, ours.s_wc, theirs.s_wc);
    near(name, ours.s_pr, theirs.s_pr);
    near(name, ours.s_eff, theirs.s_eff);
  };
  near_scale("fan", sized.fan.scale, listed.fan.scale);
  near_scale("LPC", sized.lpc.scale, listed.lpc.scale);
  near_scale("HPC", sized.hpc.scale, listed.hpc.scale);
  near_scale("HPT", sized.hpt.scale, listed.hpt.scale);
  near_scale("LPT", sized.lpt.scale, listed.lpt.scale);
  near("core nozzle", sized.core_nozzle.area_m2, listed.core_nozzle.area_m2);
  near("bypass nozzle", sized.bypass_nozzle.area_m2, listed.bypass_nozzle.area_m2);
  near("station 30", sized.hpc_exit_area_m2, listed.hpc_exit_area_m2);
  near("fuel flow", sized.design.fuel_flow_kg_s, listed.design.fuel_flow_kg_s);
}

TEST(Sizing, NamesWhatNoEngineCanMeet) {
  EngineDesign design = high_bypass_design();
  design.t40_k = 700.0;  // below T30
  try {
    size_engine(design);
    FAIL();
  } catch (const SolveError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("residual '"));
  }
}

}  // namespace
}  // namespace ehm::engine_sim
