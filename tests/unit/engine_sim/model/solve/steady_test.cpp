// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/solve/steady.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "engine_sim/engines/jt9d.h"

namespace ehm::engine_sim {
namespace {

constexpr FlightCondition cruise{10668.0, 0.8, 0.0};

TEST(Steady, EveryKindOfDemandFindsTheSamePoint) {
  const Turbofan engine(jt9d());
  const SteadyPoint a = solve_steady(engine, cruise, {}, {DemandKind::n1_rpm, 3400.0});
  EXPECT_NEAR(a.gas.speeds.n1_rpm, 3400.0, 1e-7);
  for (const Demand& demand :
       {Demand{DemandKind::fuel_flow_kg_s, a.gas.fuel_flow_kg_s}, Demand{DemandKind::net_thrust_n, a.gas.net_thrust_n},
        Demand{DemandKind::t40_k, a.gas.s40.tt_k}}) {
    const SteadyPoint b = solve_steady(engine, cruise, {}, demand);
    EXPECT_NEAR(b.gas.speeds.n1_rpm, a.gas.speeds.n1_rpm, 1e-7 * a.gas.speeds.n1_rpm);
    EXPECT_NEAR(b.gas.speeds.n2_rpm, a.gas.speeds.n2_rpm, 1e-7 * a.gas.speeds.n2_rpm);
    EXPECT_NEAR(b.gas.net_thrust_n, a.gas.net_thrust_n, 1e-7 * a.gas.net_thrust_n);
    EXPECT_LT(b.residual, 1e-10);
  }
}

TEST(Steady, WarmStartAgreesWithColdStartAndIsNoLonger) {
  const Turbofan engine(jt9d());
  const SteadyPoint start = solve_steady(engine, cruise, {}, {DemandKind::n1_rpm, 3400.0});
  HealthVector worn{};
  worn[hpc_efficiency] = -0.02;
  const SteadyPoint warm = solve_steady(engine, cruise, worn, {DemandKind::n1_rpm, 3410.0}, &start);
  const SteadyPoint cold = solve_steady(engine, cruise, worn, {DemandKind::n1_rpm, 3410.0});
  EXPECT_NEAR(warm.gas.s40.tt_k, cold.gas.s40.tt_k, 1e-7);
  EXPECT_LE(warm.iterations, cold.iterations);
  EXPECT_GT(warm.gas.s40.tt_k, start.gas.s40.tt_k);  // a worn compressor runs the engine hotter
}

TEST(Steady, RefusesADemandThatMeansNothing) {
  const Turbofan engine(jt9d());
  EXPECT_THROW(solve_steady(engine, cruise, {}, {DemandKind::n1_rpm, -1.0}), std::invalid_argument);
  EXPECT_THROW(solve_steady(engine, cruise, {}, {DemandKind::fuel_flow_kg_s, std::numeric_limits<double>::quiet_NaN()}),
               std::invalid_argument);
  EXPECT_THROW(solve_steady(engine, {30000.0, 0.8, 0.0}, {}, {DemandKind::n1_rpm, 3000.0}), std::out_of_range);
}

TEST(Steady, SpeedAndRatingAreDemandsToo) {
  const Turbofan engine(jt9d());
  const SteadyPoint a = solve_steady(engine, cruise, {}, {DemandKind::limit_ratio, 0.95});
  const SteadyPoint b = solve_steady(engine, cruise, {}, {DemandKind::n2_rpm, a.gas.speeds.n2_rpm});
  EXPECT_NEAR(b.gas.speeds.n1_rpm, a.gas.speeds.n1_rpm, 1e-6);
}

TEST(Steady, NamesTheResidualOfADemandOutOfReach) {
  const Turbofan engine(jt9d());
  try {
    solve_steady(engine, cruise, {}, {DemandKind::net_thrust_n, 500e3});  // ten times what it can give
    FAIL();
  } catch (const SolveError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("residual '"));
  }
}

}  // namespace
}  // namespace ehm::engine_sim
