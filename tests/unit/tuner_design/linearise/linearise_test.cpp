// SPDX-License-Identifier: Apache-2.0
// The linear model against the nonlinear engine that it was made from.

#include "tuner_design/linearise/linearise.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/engine_file.h"
#include "engine_sim/engines/jt9d.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/linear_model/model_check.h"
#include "engine_sim/scenario/life.h"
#include "monitor/estimation/steady_gain.h"
#include "tuner_design/design/design_tuner.h"

namespace ehm::tuner_design {
namespace {

class LineariseAtCruise : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    options.flight = {10668.0, 0.8, 0.0};
    options.demand = {engine_sim::DemandKind::t40_k, 1308.6};
    result = linearise(engine_sim::default_engine(), options);
  }
  static inline const engine_sim::Turbofan turbofan{engine_sim::jt9d()};
  static inline LineariseOptions options;
  static inline Linearisation result;
};

TEST_F(LineariseAtCruise, StepBalancesTruncationAndRoundOff) {
  EXPECT_GT(result.study.step, result.study.rows.back().step);
  EXPECT_LT(result.study.step, result.study.rows.front().step);
  for (const StepStudyRow& row : result.study.rows) {
    EXPECT_TRUE(row.step != result.study.step || row.change < 1e-5) << row.step << ' ' << row.change;
  }
}

TEST_F(LineariseAtCruise, IsAValidStableModel) {
  EXPECT_NO_THROW(linear_model::check_model(result.model, "linearised"));
  EXPECT_EQ(result.model.health.size(), 10U);
  EXPECT_EQ(result.model.sensors.size(), 7U);
  EXPECT_EQ(result.model.auxiliary.size(), 4U);
  // The speeds are states and sensors at once.
  EXPECT_TRUE(result.model.C.topRows(2).isIdentity(1e-9));
  EXPECT_LT(result.model.M.topRows(2).norm(), 1e-9);
}

TEST_F(LineariseAtCruise, NamesTheEngineThatItWasMadeFrom) {
  EXPECT_EQ(result.model.engine_type, "jt9d");
  EXPECT_EQ(result.model.name, "JT9D-class turbofan, 10668 m, Mach 0.8, ISA +0 K, T40 1309 K");
  engine_sim::EngineDefinition other = engine_sim::jt9d_engine();
  other.data.name = "Test bed turbofan";
  LineariseOptions quick = options;
  quick.fleet = 0;
  const linear_model::LinearModel model =
      linearise(std::make_shared<const engine_sim::EngineDefinition>(other), quick).model;
  EXPECT_EQ(model.engine_type, "test-bed-turbofan");
  EXPECT_EQ(result.model.engine_hash, engine_sim::engine_hash(engine_sim::jt9d_engine()));
  EXPECT_NE(model.engine_hash, result.model.engine_hash);
  EXPECT_EQ(model.name, "Test bed turbofan, 10668 m, Mach 0.8, ISA +0 K, T40 1309 K");
}

TEST_F(LineariseAtCruise, AHalfWornEngineHasATrimOfItsOwn) {
  LineariseOptions worn = options;
  worn.fleet = 0;
  worn.health = engine_sim::health_of({.cycles = 3000.0});
  const linear_model::LinearModel model = linearise(engine_sim::default_engine(), worn).model;
  EXPECT_NO_THROW(linear_model::check_model(model, "half worn"));
  // At the same T40 a worn engine turns slower and gives less thrust.
  EXPECT_LT(model.states[0].trim, result.model.states[0].trim);
  EXPECT_LT(model.auxiliary[2].trim, result.model.auxiliary[2].trim);
}

TEST_F(LineariseAtCruise, SteadyGainPredictsASmallDeterioration) {
  // 0.1 % lost in each parameter in turn at constant fuel flow; the nonlinear change is off by second order only.
  const engine_sim::SteadyPoint trim =
      engine_sim::solve_steady(turbofan, options.flight, options.health, options.demand);
  const engine_sim::Demand fuel{engine_sim::DemandKind::fuel_flow_kg_s, trim.operation.fuel_flow_kg_s};
  const estimation::SteadyGain steady = estimation::steady_gain(result.model);
  for (std::size_t i = 0; i < engine_sim::health_count; ++i) {
    SCOPED_TRACE(engine_sim::health_names[i]);
    engine_sim::HealthVector health{};
    health[i] = -0.001;
    const engine_sim::SteadyPoint worn = engine_sim::solve_steady(turbofan, options.flight, health, fuel);
    const auto column = as_index(i);
    const Eigen::VectorXd change = -0.001 * steady.H.col(column);
    const double trims[] = {trim.gas.speeds.n1_rpm, trim.gas.s30.tt_k, trim.gas.ps_30_pa};
    const double actual[] = {worn.gas.speeds.n1_rpm - trim.gas.speeds.n1_rpm, worn.gas.s30.tt_k - trim.gas.s30.tt_k,
                             worn.gas.ps_30_pa - trim.gas.ps_30_pa};
    const double predicted[] = {change(0), change(5), change(4)};
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(actual[k] / trims[k], predicted[k] / trims[k], 3e-5) << k;
    EXPECT_NEAR((worn.gas.net_thrust_n - trim.gas.net_thrust_n) / trim.gas.net_thrust_n,
                -0.001 * steady.Hz(2, column) / trim.gas.net_thrust_n, 3e-5);
  }
}

TEST_F(LineariseAtCruise, DesignOnTheTangentComesNearTheLimitOfTheLinearEngine) {
  const design::Design design = design_tuner(result.model, {});
  const design::ErrorByChannel real = design.real_error();
  EXPECT_LT(real.health.sum() / design.bayes_limit.health.sum(), 1.05);
  EXPECT_LT(real.auxiliary.sum() / design.bayes_limit.auxiliary.sum(), 1.10);
  // The engine is not linear: the HPC runs where its map's speed lines change their spacing. What the tangent misses
  // counts in the estimate, so that of HPC flow little more is told than the fleet's own 2 %, but nothing worse.
  EXPECT_TRUE(worse_than_prior(design.full, design.model, design.scaling).empty());
  EXPECT_GT(std::sqrt(design.full.health_total_covariance(5, 5)), 1.5);
}

TEST_F(LineariseAtCruise, DesignOnTheFleetsFitIsBetterInAllAndNearThePrior) {
  LineariseOptions fleet = options;
  fleet.method = LineariseMethod::fleet;
  const design::Design tangent = design_tuner(result.model, {});
  const design::Design design = design_tuner(linearise(engine_sim::default_engine(), fleet).model, {});
  EXPECT_LT(design.full.health_total_covariance.trace(), tangent.full.health_total_covariance.trace());
  EXPECT_LT(design.bayes_limit.health.sum(), 0.97 * tangent.bayes_limit.health.sum());
  EXPECT_TRUE(worse_than_prior(design.full, design.model, design.scaling).empty());
  EXPECT_LT(std::sqrt(design.full.health_total_covariance(5, 5)), 1.5);  // HPC flow; the fleet's own spread is 2 %
  EXPECT_LT(std::sqrt(design.full.health_total_covariance.diagonal().maxCoeff()), 1.65);
  for (const auto& subset : design.missing) {
    ASSERT_TRUE(subset.has_value());
    EXPECT_LT(std::sqrt(subset->health_total_covariance.diagonal().maxCoeff()), 2.0);
  }
}

TEST_F(LineariseAtCruise, TheFleetsFitBalancesAtItsTrim) {
  LineariseOptions fleet = options;
  fleet.method = LineariseMethod::fleet;
  const linear_model::LinearModel fit = linearise(engine_sim::default_engine(), fleet).model;
  EXPECT_DOUBLE_EQ(fit.states[0].trim, result.model.states[0].trim);  // the fan speed is the demand
  // The fleet is symmetric, the engine is not: its average lies near the new engine, not on it.
  for (std::size_t i = 0; i < fit.sensors.size(); ++i)
    EXPECT_NEAR(fit.sensors[i].trim, result.model.sensors[i].trim, 0.02 * result.model.sensors[i].trim);
  EXPECT_TRUE(fit.C.topRows(2).isIdentity(1e-6));
}

TEST_F(LineariseAtCruise, TheFleetsFitHasTheEnginesDynamics) {
  // Averaged slopes, not slopes that carry what health does: the kink of the HPC's map changes them by a third at most.
  LineariseOptions fleet = options;
  fleet.method = LineariseMethod::fleet;
  const linear_model::LinearModel fit = linearise(engine_sim::default_engine(), fleet).model;
  const Eigen::VectorXd own = fit.A.eigenvalues().real(), tangent = result.model.A.eigenvalues().real();
  EXPECT_NEAR(own.maxCoeff() / tangent.maxCoeff(), 1.0, 0.35);
  EXPECT_NEAR(own.minCoeff() / tangent.minCoeff(), 1.0, 0.35);
  for (Eigen::Index i = 0; i < 2; ++i) EXPECT_NEAR(fit.B(i, 0) / result.model.B(i, 0), 1.0, 0.35) << i;
}

TEST_F(LineariseAtCruise, VanesBleedValvesAndOfftakeAreControls) {
  ASSERT_EQ(result.model.controls.size(), 5U);
  const engine_sim::SteadyPoint trim = engine_sim::solve_steady(turbofan, options.flight, {}, options.demand);
  engine_sim::Operation closed = trim.operation;
  closed.geometry.vsv_deg = 0.01;
  engine_sim::FlowUnknowns unknowns = trim.unknowns;
  const double t30_k = turbofan.gas_path(closed, trim.gas.speeds, unknowns).s30.tt_k;
  EXPECT_NEAR(result.model.D(5, 1), (t30_k - trim.gas.s30.tt_k) / 0.01, 0.02 * std::abs(result.model.D(5, 1)));
  // open bleed valves take air from behind the LPC: its pressure falls, its margin grows
  EXPECT_LT(result.model.D(2, 2), 0.0);
  EXPECT_GT(result.model.G(3, 2), 0.0);
  // air for the cabin is missing in the burner: T48 rises; shaft power brakes the core and moves no reading at once
  EXPECT_GT(result.model.D(6, 3), 0.0);
  EXPECT_LT(result.model.B(1, 4), 0.0);
  EXPECT_TRUE(result.model.D.col(4).isZero(1e-8));  // per W: what differences leave
}

TEST_F(LineariseAtCruise, HeatSoakAddsSlowStatesAndKeepsTheSteadyGain) {
  LineariseOptions soaked = options;
  soaked.heat_soak = true;
  soaked.fleet = 0;
  const linear_model::LinearModel model = linearise(engine_sim::default_engine(), soaked).model;
  ASSERT_EQ(model.A.rows(), 5);
  EXPECT_NO_THROW(linear_model::check_model(model, "soaked"));
  // C k/C of jt9d.cpp: 25, 15 and 30 s, somewhat changed by the engine around them
  const Eigen::VectorXd slow = model.A.eigenvalues().real();
  EXPECT_NEAR(slow.maxCoeff(), -1.0 / 30.0, 0.01);
  EXPECT_LT(slow.minCoeff(), -3.0);
  // metal as hot as the gas exchanges nothing
  const estimation::SteadyGain with = estimation::steady_gain(model), without = estimation::steady_gain(result.model);
  EXPECT_LT((with.H - without.H).norm(), 1e-3 * without.H.norm());
}

TEST_F(LineariseAtCruise, SensorLagsBecomeStatesWithTheirTimeConstants) {
  LineariseOptions lagging = options;
  lagging.sensors.lag_pressure_s = 0.04;
  lagging.sensors.lag_temperature_s = 0.7;
  lagging.fleet = 0;
  const linear_model::LinearModel model = linearise(engine_sim::default_engine(), lagging).model;
  ASSERT_EQ(model.A.rows(), 2 + 2 + 3);  // P24, Ps30; T24, T30, T48
  EXPECT_NO_THROW(linear_model::check_model(model, "lagging"));
  EXPECT_EQ(model.states[2].name, "P24_sensor");
  EXPECT_NEAR(model.A(2, 2), -25.0, 1e-12);
  EXPECT_NEAR(model.A(3, 3), -1.0 / 0.7, 1e-12);
  EXPECT_EQ(model.D.bottomRows(5).norm(), 0.0);
  const estimation::SteadyGain with = estimation::steady_gain(model), without = estimation::steady_gain(result.model);
  EXPECT_LT((with.H - without.H).norm(), 1e-9 * without.H.norm());
  EXPECT_NO_THROW(design_tuner(model, {}));
}

TEST_F(LineariseAtCruise, HealthAtTrimIsRecorded) {
  LineariseOptions worn = options;
  worn.health[engine_sim::hpc_efficiency] = -0.01;
  EXPECT_EQ(linearise(engine_sim::default_engine(), worn).model.health[engine_sim::hpc_efficiency].trim, -0.01);
}

}  // namespace
}  // namespace ehm::tuner_design
