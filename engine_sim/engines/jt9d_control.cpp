// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/jt9d_control.h"

#include "engine_sim/engines/jt9d.h"

namespace ehm::engine_sim {
namespace {

// The engine's ratings; Ps30 goes with their P30 (0.9417 of it at maximum), rounded up.
EngineLimits limits(const Ratings& ratings) {
  return {.n1_rpm = ratings.n1_max_rpm,
          .n1_corrected_rpm = ratings.corrected_n1_max_rpm,
          .n2_rpm = ratings.n2_max_rpm,
          .n2_corrected_rpm = ratings.corrected_n2_max_rpm,
          .t48_k = ratings.t48_max_k,
          .ps_30_pa = 2.2e6,
          .ground_idle_n2_corrected_rpm = ratings.ground_idle_corrected_n2_rpm,
          .flight_idle_n2_corrected_rpm = ratings.flight_idle_corrected_n2_rpm};
}

// Gains and lags: linear model of the new engine, mean of five flight conditions from sea level static to 13.5 km;
// fuel_response_test compares them with the model. Assumptions: the bandwidths, how the reference is led, a slew that
// crosses the schedules in 0.5 s, the valve's range.
// Ratio units go with theta2^0.68 and not its root, because real gas takes more fuel for the same ratio of
// temperatures: steady points of the model at ISA - 20 to + 35 K. Acceleration: above what any engine with -4 to +1 %
// of each health parameter needs in steady state (largest of 150: 0.73 at 6300, 0.92 at 6800, 1.07 at 7200, 1.22 at
// 7600, 1.33 at 7900 rpm), low enough to leave the HPC its margin. Deceleration: 0.58 to 0.64 of the least steady line.
// The margins that both leave: control_study_test.
FuelControlData fuel() {
  return {.n1_gain = {{1600, 0.48}, {2200, 0.40}, {2800, 0.35}, {3200, 0.32}, {3600, 0.27}, {3900, 0.52}},
          .n1_lag_s = {{1600, 0.80}, {2200, 0.55}, {2800, 0.37}, {3200, 0.30}, {3600, 0.23}, {3900, 0.38}},
          .n2_gain = {{1600, 0.100}, {2200, 0.095}, {2800, 0.100}, {3200, 0.102}, {3600, 0.108}, {3900, 0.118}},
          .n2_lag_s = {{1600, 0.66}, {2200, 0.46}, {2800, 0.31}, {3200, 0.24}, {3600, 0.165}, {3900, 0.165}},
          .t48 = {0.46, 0.0},
          .ps_30 = {0.70, 0.16},
          .speed_bandwidth_rad_s = 2.0,
          .t48_bandwidth_rad_s = 5.0,
          .ps_30_bandwidth_rad_s = 3.0,
          .reference_band = 0.03,
          .reference_fuel_rate_per_s = 0.5,
          .acceleration =
              {{5500, 0.74}, {6300, 0.87}, {6800, 1.01}, {7200, 1.12}, {7600, 1.255}, {7900, 1.35}, {8300, 1.42}},
          .deceleration =
              {{5500, 0.20}, {6300, 0.30}, {6800, 0.40}, {7200, 0.48}, {7600, 0.58}, {7900, 0.66}, {8300, 0.75}},
          .theta_exponent = 0.68,
          .slew_per_s = 1.5,
          .fuel_min_kg_s = 0.02,
          .fuel_max_kg_s = 3.5};
}

// An assumption, line and servo: the model feels only the deviation from the schedule, which its map holds on. Closed
// by 40 degrees at idle, open at take-off; a stroke takes 1.6 s.
VaneControlData vanes() {
  return {.schedule_deg = {{5800, 40.0}, {7900, 0.0}}, .actuator = {0.1, 25.0, 25.0}};
}

// Shut at and above the core speeds of power code 40 (6974 rpm corrected and more), open at idle: after a cut of fuel
// the core is slow and the fan still fast, which is when the LPC needs it. Steady LPC stall margin at a fan speed of
// 2000 rpm corrected, valves shut: new engine 12.9 % at sea level static, 7.5 % at cruise; worst of 150 worn ones 9.3
// and 4.5 %; 10 % bleed gives back 4 to 6 points. In a deceleration: steady running is at 1.4 times the deceleration
// schedule and more, so the valves stay out of it; they shut slowly, so that a reversal finds them open. Fraction and
// speeds of the servo: assumptions.
BleedValveControlData bleed_valves() {
  return {.low_speed = {{6700, 0.12}, {6940, 0.0}},
          .deceleration = {{1.1, 0.10}, {1.4, 0.0}},
          .actuator = {0.0, 0.3, 0.03}};
}

}  // namespace

ControlData jt9d_control() {
  return {.limits = limits(jt9d().ratings),
          .fuel = fuel(),
          .vanes = vanes(),
          .bleed_valves = bleed_valves(),
          .middle_n1_corrected_rpm = 3000.0};
}

}  // namespace ehm::engine_sim
