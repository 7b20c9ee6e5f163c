// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/control/fan_speed_demand.h"

#include <gtest/gtest.h>

#include "tests/unit/engine_sim/control/controlled_flight.h"

namespace {

using namespace ehm::engine_sim;
using namespace ehm::test;

TEST(FanSpeedDemand, TakesAFanSpeedAsItIs) {
  FanSpeedDemand demand(new_engine(), jt9d_control());
  EXPECT_EQ(demand.n1_rpm({DemandKind::n1_rpm, 4999.0}, cruise), 4999.0);
  EXPECT_THROW(demand.n1_rpm({DemandKind::t40_k, 1300.0}, cruise), std::invalid_argument);
}

TEST(FanSpeedDemand, GivesTheThrustOfTheNewEngine) {
  FanSpeedDemand demand(new_engine(), jt9d_control());
  for (const FlightCondition& flight : {cruise, ceiling, sea_level})
    for (const double n1c : {2200.0, 3000.0, 3700.0}) {
      const Demand speed{DemandKind::n1_rpm, n1c * root_theta2(flight)};
      const SteadyPoint p = solve_scheduled(new_engine(), jt9d_control(), {.flight = flight}, speed);
      EXPECT_NEAR(demand.n1_rpm({DemandKind::net_thrust_n, p.gas.net_thrust_n}, flight), speed.value,
                  1e-4 * speed.value);
    }
}

TEST(FanSpeedDemand, OutOfReachIsTheLimitOrIdle) {
  const EngineLimits limit = jt9d_control().limits;
  FanSpeedDemand demand(new_engine(), jt9d_control());
  EXPECT_DOUBLE_EQ(demand.n1_rpm({DemandKind::net_thrust_n, 1e6}, sea_level), limit.n1_rpm);
  EXPECT_NEAR(demand.n1_rpm({DemandKind::net_thrust_n, 1e6}, ceiling), limit.n1_corrected_rpm * root_theta2(ceiling),
              1e-9);
  EXPECT_LT(demand.n1_rpm({DemandKind::net_thrust_n, -1e5}, sea_level), 1000.0);
}

TEST(FanSpeedDemand, FollowsTheFlight) {
  FanSpeedDemand demand(new_engine(), jt9d_control());
  const Demand thrust{DemandKind::net_thrust_n, 40e3};
  const double there = demand.n1_rpm(thrust, cruise);
  EXPECT_EQ(demand.n1_rpm(thrust, {cruise.altitude_m + 1.0, cruise.mach, 0.0}), there);  // too little to be felt
  EXPECT_LT(demand.n1_rpm(thrust, {cruise.altitude_m - 1000.0, cruise.mach, 0.0}), there);
}

}  // namespace
