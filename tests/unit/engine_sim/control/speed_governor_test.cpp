// SPDX-License-Identifier: Apache-2.0
// The fan speed loop on the nonlinear engine: small steps alike everywhere, large ones quick and without a bump.

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/unit/engine_sim/control/controlled_flight.h"

namespace {

using namespace ehm::engine_sim;
using namespace ehm::test;

TEST(SpeedGovernor, ASmallStepIsAnsweredAlikeFromSeaLevelToTheCeiling) {
  const double bandwidth_rad_s = jt9d_control().fuel.speed_bandwidth_rad_s;
  for (const FlightCondition& flight : {sea_level, cruise, ceiling, FlightCondition{13500.0, 0.5, -20.0}})
    for (const double n1c : {2700.0, 3100.0, 3500.0, 3800.0}) {
      const double from = n1c * root_theta2(flight), to = 1.01 * from;
      ControlledFlight run(flight, from);
      double reached_63_s = 0.0, most = 0.0;
      run.fly(to, 10.0, [&](const ControlledSample& s, double t_s) {
        const double done = (s.gas.speeds.n1_rpm - from) / (to - from);
        if (done < 1.0 - std::exp(-1.0)) reached_63_s = t_s;
        most = std::max(most, done);
      });
      const double last = (run.fly(to, 0.1).gas.speeds.n1_rpm - from) / (to - from);
      std::printf("%6.0f m M %.1f N1c %.0f: 63 %% after %.2f s, overshoot %4.1f %%\n", flight.altitude_m, flight.mach,
                  n1c, reached_63_s, 100.0 * (most - 1.0));
      // a first-order response reaches 63 % after 1/bandwidth; half to twice that, for gains are off by half as much
      // again (fuel_response_test) and the governor is led
      EXPECT_GT(reached_63_s, 0.5 / bandwidth_rad_s);
      EXPECT_LT(reached_63_s, 2.0 / bandwidth_rad_s);
      EXPECT_LT(most, 1.05);
      EXPECT_NEAR(last, 1.0, 0.02);
    }
}

// 14 CFR 33.73(b): from flight idle to 95 % of take-off thrust within 5 s, at sea level static.
TEST(SpeedGovernor, FromIdleToTakeOffWithinFiveSeconds) {
  const double take_off_rpm = 3750.0;
  const double full_n = solve_steady(new_engine(), sea_level, {}, {DemandKind::n1_rpm, take_off_rpm}).gas.net_thrust_n;
  ControlledFlight run(sea_level, 500.0);
  double reached_s = 1e9, most_rpm = 0.0, hpc = 1e9;
  run.fly(take_off_rpm, 15.0, [&](const ControlledSample& s, double t_s) {
    if (s.gas.net_thrust_n >= 0.95 * full_n) reached_s = std::min(reached_s, t_s);
    most_rpm = std::max(most_rpm, s.gas.speeds.n1_rpm);
    hpc = std::min(hpc, s.gas.stall_margin_hpc_percent);
  });
  std::printf("idle to 95 %% thrust in %.2f s, N1 overshoot %.2f %%, least HPC stall margin %.1f %%\n", reached_s,
              100.0 * (most_rpm / take_off_rpm - 1.0), hpc);
  EXPECT_LT(reached_s, 5.0);
  EXPECT_LT(most_rpm, 1.005 * take_off_rpm);
  EXPECT_GT(hpc, 5.0);
}

// Whichever loop takes over, fuel flow has no step: its rate is the slew's at most, and where the demand is smooth the
// rate itself does not jump by more than a tenth of that.
TEST(SpeedGovernor, LoopsChangeWithoutABump) {
  ControlData data = jt9d_control();
  data.limits.t48_k = 950.0;  // met on the way up
  ControlledFlight run(cruise, 3000.0, data);
  double demand_rpm = 3000.0, before = 0.0, rate_before = 0.0, largest_jump = 0.0;
  int changes = 0;
  FuelLoop active = FuelLoop::n1_governor;
  for (int k = 0; k < 2000; ++k) {
    demand_rpm += k < 1000 ? 0.8 : -0.8;  // 53 rpm/s up and down again
    const ControlledSample s = run.fly(demand_rpm, 0.5 * dt_s);
    const double fuel = s.actuation.fuel_flow_kg_s, rate = std::log(fuel / before) / dt_s;
    if (k > 10 && s.actuation.active != active) {
      ++changes;
      largest_jump = std::max(largest_jump, std::abs(rate - rate_before));
    }
    active = s.actuation.active, before = fuel, rate_before = rate;
  }
  std::printf("%d changes of loop, largest jump of the relative fuel rate %.4f /s\n", changes, largest_jump);
  EXPECT_GE(changes, 2);
  EXPECT_LT(largest_jump, 0.1 * data.fuel.slew_per_s);
}

}  // namespace
