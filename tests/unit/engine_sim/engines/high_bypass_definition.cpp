// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/engine_sim/engines/high_bypass_definition.h"

#include "tests/unit/engine_sim/model/high_bypass_engine.h"

namespace ehm::engine_sim {
namespace {

// The engine's ratings; Ps30 goes with their P30 (0.944 of it at maximum), rounded down.
EngineLimits limits(const Ratings& ratings) {
  return {.n1_rpm = ratings.n1_max_rpm,
          .n1_corrected_rpm = ratings.corrected_n1_max_rpm,
          .n2_rpm = ratings.n2_max_rpm,
          .n2_corrected_rpm = ratings.corrected_n2_max_rpm,
          .t48_k = ratings.t48_max_k,
          .ps_30_pa = 3.1e6,
          .ground_idle_n2_corrected_rpm = ratings.ground_idle_corrected_n2_rpm,
          .flight_idle_n2_corrected_rpm = ratings.flight_idle_corrected_n2_rpm};
}

// Made as the JT9D's (jt9d_control.cpp). Gains and lags: linear model of the new engine, mean of five flight conditions
// from sea level static to 13.5 km. Acceleration: 1.1 to 1.2 times what the worst of 1500 engines with -4 to +1 % of each
// health parameter needs in steady state (0.276 at 12 400, 0.35 at 13 700, 0.42 at 14 600, 0.51 at 15 800 rpm);
// deceleration: some 0.6 of the least steady line. Bandwidths and servos: the JT9D's.
FuelControlData fuel() {
  return {
      .n1_gain = {{2100, 0.45}, {2780, 0.43}, {3520, 0.36}, {4040, 0.32}, {4570, 0.265}, {4935, 0.40}, {5250, 0.56}},
      .n1_lag_s =
          {{2100, 0.55}, {2780, 0.385}, {3520, 0.265}, {4040, 0.205}, {4570, 0.155}, {4935, 0.195}, {5250, 0.25}},
      .n2_gain =
          {{2100, 0.098}, {2780, 0.097}, {3520, 0.102}, {4040, 0.103}, {4570, 0.108}, {4935, 0.118}, {5250, 0.121}},
      .n2_lag_s =
          {{2100, 0.44}, {2780, 0.285}, {3520, 0.197}, {4040, 0.148}, {4570, 0.106}, {4935, 0.094}, {5250, 0.091}},
      .t48 = {0.305, 0.0},
      .ps_30 = {0.70, 0.12},
      .speed_bandwidth_rad_s = 2.0,
      .t48_bandwidth_rad_s = 5.0,
      .ps_30_bandwidth_rad_s = 3.0,
      .reference_band = 0.03,
      .reference_fuel_rate_per_s = 0.5,
      .acceleration =
          {{11500, 0.31}, {12400, 0.33}, {13400, 0.385}, {14200, 0.44}, {15000, 0.50}, {15500, 0.54}, {16300, 0.58}},
      .deceleration =
          {{11500, 0.09}, {12400, 0.11}, {13400, 0.145}, {14200, 0.19}, {15000, 0.22}, {15500, 0.25}, {16300, 0.28}},
      .theta_exponent = 0.68,
      .slew_per_s = 1.5,
      .fuel_min_kg_s = 0.01,
      .fuel_max_kg_s = 1.7};
}

ControlData control(const Ratings& ratings) {
  return {.limits = limits(ratings),
          .fuel = fuel(),
          .vanes = {.schedule_deg = {{11400, 40.0}, {15500, 0.0}}, .actuator = {0.1, 25.0, 25.0}},
          .bleed_valves = {.low_speed = {{12600, 0.12}, {13200, 0.0}},
                           .deceleration = {{1.1, 0.10}, {1.4, 0.0}},
                           .actuator = {0.0, 0.3, 0.03}},
          .middle_n1_corrected_rpm = 3700.0};
}

// Other channels than the JT9D's, to show that the file decides: the fan's exit pressure is measured, HPC stall margin and
// EGT margin are asked for.
NamedChannels channels() {
  NamedChannels channels{
      {{find_output("Nf"), 0.25},
       {find_output("Nc"), 0.25},
       {find_output("P13"), 0.5},
       {find_output("P24"), 0.5},
       {find_output("T24"), 0.75},
       {find_output("Ps30"), 0.5},
       {find_output("T30"), 0.75},
       {find_output("T48"), 0.75}},
      {find_output("T40"), find_output("T50"), find_output("Fn"), find_output("SmHPC"), find_output("EGTM")},
      {find_control("fuel_flow"), find_control("VSV"), find_control("VBV"), find_control("customer_bleed"),
       find_control("power_offtake")},
      {}};
  for (std::size_t i = 0; i < health_count; ++i) channels.health.push_back({static_cast<Health>(i), 0.02});
  return channels;
}

}  // namespace

EngineDefinition high_bypass_definition() {
  const SizedEngine sized = size_engine(high_bypass_design());
  return {
      "pyCycle, example_cycles/high_bypass_turbofan.py (NASA, Apache-2.0), sized at its design point on the JT9D's map "
      "shapes; inertias, ratings, control and heat soak are estimates "
      "(tests/unit/engine_sim/engines/high_bypass_definition.cpp)",
      sized.data, control(sized.data.ratings), channels()};
}

}  // namespace ehm::engine_sim
