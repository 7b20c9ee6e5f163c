// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "engine_sim/scenario/deterioration.h"
#include "engine_sim/scenario/flight_profile.h"

namespace {

using namespace ehm::engine_sim;

TEST(Deterioration, AddsWearDriftStepsAndRamps) {
  Scenario s;
  s.wear[hpc_efficiency] = {-0.01, -1e-5};
  s.health_changes = {{10.0, hpc_efficiency, -0.02, 0.0}, {20.0, hpc_efficiency, 0.01, 10.0}};
  const Deterioration d(s);
  EXPECT_DOUBLE_EQ(d.at(0.0)[hpc_efficiency], -0.01);
  EXPECT_DOUBLE_EQ(d.at(9.9)[hpc_efficiency], -0.01 - 9.9e-5);
  EXPECT_DOUBLE_EQ(d.at(10.0)[hpc_efficiency], -0.01 - 1e-4 - 0.02);
  EXPECT_DOUBLE_EQ(d.at(25.0)[hpc_efficiency], -0.01 - 2.5e-4 - 0.02 + 0.005);
  EXPECT_DOUBLE_EQ(d.at(100.0)[hpc_efficiency], -0.01 - 1e-3 - 0.02 + 0.01);
  EXPECT_DOUBLE_EQ(d.at(100.0)[fan_flow], 0.0);
}

TEST(Deterioration, AnOrderReachesItsTargetWhateverWasOnItsWay) {
  Scenario s;
  s.health_changes = {{0.0, hpc_flow, -0.02, 10.0}, {30.0, hpc_flow, -0.01, 0.0}};
  Deterioration d(s);
  d.order(hpc_flow, -0.03, 4.0, 5.0);  // halfway down the first ramp, at -0.01
  EXPECT_DOUBLE_EQ(d.at(5.0)[hpc_flow], -0.01);
  EXPECT_DOUBLE_EQ(d.at(7.0)[hpc_flow], -0.02);
  EXPECT_DOUBLE_EQ(d.at(20.0)[hpc_flow], -0.03);
  EXPECT_DOUBLE_EQ(d.at(31.0)[hpc_flow], -0.04);
}

TEST(FlightProfile, InterpolatesAndHolds) {
  FlightProfile p({}, {{10.0, {1000.0, 0.4, 0.0}, {DemandKind::n1_rpm, 3000.0}},
                       {20.0, {2000.0, 0.5, 10.0}, {DemandKind::n1_rpm, 3500.0}}});
  EXPECT_DOUBLE_EQ(p.at(0.0).demand.value, 3000.0);
  EXPECT_DOUBLE_EQ(p.at(15.0).flight.altitude_m, 1500.0);
  EXPECT_DOUBLE_EQ(p.at(15.0).demand.value, 3250.0);
  EXPECT_DOUBLE_EQ(p.at(99.0).flight.delta_isa_k, 10.0);
}

TEST(FlightProfile, AnOperatorsOrderHoldsFromThenOn) {
  FlightProfile p({0.0, {1000.0, 0.4, 0.0}, {DemandKind::n1_rpm, 3000.0}}, {});
  p.override_demand({DemandKind::n1_rpm, 3300.0});
  EXPECT_DOUBLE_EQ(p.at(5.0).demand.value, 3300.0);
  EXPECT_DOUBLE_EQ(p.at(5.0).flight.altitude_m, 1000.0);
  p.override_flight({2000.0, 0.5, 0.0});
  EXPECT_DOUBLE_EQ(p.at(5.0).flight.altitude_m, 2000.0);
}

}  // namespace
