// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/solve/flow_balance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_sim/engines/jt9d.h"
#include "tests/unit/engine_sim/model/throttle_slam.h"

namespace ehm::engine_sim {
namespace {

/// What a difference in the solution would show in.
std::vector<double> readings(const GasPath& g) {
  return {g.s2.w_kg_s, g.s21.w_kg_s, g.s24.pt_pa, g.s30.pt_pa,    g.s30.tt_k,     g.s40.tt_k, g.s48.pt_pa,
          g.s48.tt_k,  g.s50.pt_pa,  g.s50.tt_k,  g.net_thrust_n, g.bypass_ratio, g.ps_30_pa};
}

void expect_same(const GasPath& a, const GasPath& b, double relative) {
  const std::vector<double> x = readings(a), y = readings(b);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], y[i], relative * std::abs(y[i])) << "reading " << i;
}

TEST(FlowBalance, ContinuesToTheSolutionThatNewtonFinds) {
  const Turbofan engine(jt9d());
  for (const FlightCondition& flight : slam_flights) {
    const ThrottleSlam slam(engine, flight, 1.0);
    FlowBalance balance(engine);
    FlowUnknowns unknowns = slam.idle().unknowns;
    // at the idle speeds the fuel flow alone rises: the cycle moves far, the spools do not
    for (double t = 0.0; t < 0.6; t += 0.015) {
      FlowUnknowns alone = slam.idle().unknowns;
      expect_same(balance.solve(slam.at(t), slam.idle().gas.speeds, unknowns),
                  engine.gas_path(slam.at(t), slam.idle().gas.speeds, alone), 1e-9);
    }
  }
}

TEST(FlowBalance, NeedsNoExactEvaluationWhereLittleChanges) {
  const Turbofan engine(jt9d());
  const ThrottleSlam slam(engine, high_cruise, 5.0);
  FlowBalance balance(engine);
  FlowUnknowns unknowns = slam.idle().unknowns;
  Operation operation = slam.idle().operation;
  balance.solve(operation, slam.idle().gas.speeds, unknowns);
  EXPECT_GT(balance.exact_evaluations(), 0);
  for (int k = 0; k < 50; ++k) {
    operation.fuel_flow_kg_s *= 1.002;
    balance.solve(operation, slam.idle().gas.speeds, unknowns);
    EXPECT_EQ(balance.exact_evaluations(), 0);
    EXPECT_LE(balance.plain_evaluations(), 8);
  }
}

TEST(FlowBalance, StartsAgainWithNewtonAfterALeap) {
  const Turbofan engine(jt9d());
  const ThrottleSlam low(engine, sea_level_static, 1.0), high(engine, ceiling, 1.0);
  FlowBalance balance(engine);
  FlowUnknowns unknowns = low.idle().unknowns;
  balance.solve(low.idle().operation, low.idle().gas.speeds, unknowns);
  const GasPath leapt = balance.solve(high.idle().operation, high.idle().gas.speeds, unknowns);
  EXPECT_GT(balance.exact_evaluations(), 0);
  expect_same(leapt, high.idle().gas, 1e-9);
}

TEST(FlowBalance, NamesTheBalanceThatCannotCloseAndGoesOnAfterwards) {
  const Turbofan engine(jt9d());
  const ThrottleSlam slam(engine, high_cruise, 1.0);
  const SteadyPoint& idle = slam.idle();
  FlowBalance balance(engine);
  FlowUnknowns unknowns = idle.unknowns;
  balance.solve(idle.operation, idle.gas.speeds, unknowns);
  FlowUnknowns lost = unknowns;
  try {
    balance.solve(idle.operation, {9000.0, 3000.0}, lost);  // a fan at more than twice its speed
    FAIL();
  } catch (const SolveError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("residual '"));
  }
  expect_same(balance.solve(idle.operation, idle.gas.speeds, unknowns), idle.gas, 1e-9);
  EXPECT_THROW(balance.solve(idle.operation, {0.0, 7000.0}, unknowns), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::engine_sim
