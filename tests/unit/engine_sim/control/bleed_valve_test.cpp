// SPDX-License-Identifier: Apache-2.0
// Bleed valves and stator vanes under control.

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/unit/engine_sim/control/controlled_flight.h"

namespace {

using namespace ehm::engine_sim;
using namespace ehm::test;

SteadyPoint trimmed(const FlightCondition& flight, const Demand& demand) {
  return solve_scheduled(new_engine(), jt9d_control(), {.flight = flight}, demand);
}

// The steady reference cases know no bleed valves: power code 40 and more stays undisturbed.
TEST(BleedValves, AreExactlyClosedInSteadyFlightFromPowerCode40) {
  EXPECT_EQ(trimmed(cruise, {DemandKind::t40_k, 1308.6}).operation.geometry.vbv_fraction, 0.0);
  for (const FlightCondition& flight : {sea_level, FlightCondition{0.0, 0.4, 15.0}, cruise, ceiling}) {
    const double full_n = trimmed(flight, {DemandKind::n1_rpm, 3750.0 * root_theta2(flight)}).gas.net_thrust_n;
    for (const double share : {0.42, 0.6, 0.8, 1.0}) {
      EXPECT_EQ(trimmed(flight, {DemandKind::net_thrust_n, share * full_n}).operation.geometry.vbv_fraction, 0.0)
          << flight.altitude_m << " m, " << share;
    }
  }
}

TEST(BleedValves, GiveTheLpcBackItsMarginAtLowPower) {
  for (const FlightCondition& flight : {sea_level, cruise, ceiling}) {
    const Demand low{DemandKind::n1_rpm, 1900.0 * root_theta2(flight)};
    const SteadyPoint open = trimmed(flight, low), closed = solve_steady(new_engine(), flight, {}, low);
    std::printf("%6.0f m at N1c 1900 rpm: LPC stall margin %.1f %% with the valves, %.1f %% without\n",
                flight.altitude_m, open.gas.stall_margin_lpc_percent, closed.gas.stall_margin_lpc_percent);
    EXPECT_GT(open.operation.geometry.vbv_fraction, 0.05);
    EXPECT_GT(open.gas.stall_margin_lpc_percent, closed.gas.stall_margin_lpc_percent + 3.0);
  }
}

TEST(BleedValves, OpenInADecelerationAndCloseAgain) {
  const double full_rpm = 3800.0 * root_theta2(cruise), low_rpm = 2700.0 * root_theta2(cruise);
  const ActuatorData servo = jt9d_control().bleed_valves.actuator;
  ControlledFlight run(cruise, full_rpm);
  double widest = 0.0, last = 0.0;
  const ControlledSample end = run.fly(low_rpm, 30.0, [&](const ControlledSample& s, double) {
    EXPECT_LE(s.actuation.vbv_fraction - last, servo.rising_per_s * dt_s * (1 + 1e-12));
    EXPECT_GE(s.actuation.vbv_fraction - last, -servo.falling_per_s * dt_s * (1 + 1e-12));
    last = s.actuation.vbv_fraction;
    widest = std::max(widest, last);
  });
  EXPECT_GT(widest, 0.02);
  EXPECT_EQ(end.actuation.vbv_fraction, 0.0);
}

TEST(StatorVanes, AreOnScheduleAtRestAndLagInASlam) {
  ControlledFlight run(sea_level, 500.0);
  EXPECT_NEAR(run.fly(500.0, 0.5).geometry.vsv_deg, 0.0, 1e-4);
  double most = 0.0;
  const ControlledSample end =
      run.fly(3750.0, 20.0, [&](const ControlledSample& s, double) { most = std::max(most, s.geometry.vsv_deg); });
  std::printf("vanes lag %.2f degrees at most\n", most);
  EXPECT_GT(most, 0.1);  // closed too far while the core accelerates
  EXPECT_LT(most, 3.0);
  EXPECT_NEAR(end.geometry.vsv_deg, 0.0, 1e-3);
  EXPECT_NEAR(end.actuation.vsv_deg, scheduled(jt9d_control().vanes.schedule_deg, measure(end.gas).n2_corrected_rpm()),
              0.01);
}

}  // namespace
