// SPDX-License-Identifier: Apache-2.0
#pragma once
// The scenario file (TOML) and everything else that configures engine_sim, through the one schema.
//
//   [engine] id, source_id, model, heat_soak    [aircraft] customer_bleed_kg_s, power_w
//   [run] sample_time_s, duration_s, seed, rate, lockstep_window, wait_for_monitors
//   [linear] model                              [replay] file, column_map, stamps
//   [flight] altitude_m, mach, delta_isa_k      [demand] kind, value
//   [sensors] noise, lags, quantisation         [control] hold_limits, speed_bandwidth_rad_s     [dds]      [log] level
//   [mission] name, time_scale, delta_isa_k, offtake, power
//   [life] cycles, washed_at, replaced_at, seed (life.h)
//   [mismatch] build, soak, inputs, seed, and each cause by its name (mismatch.h)
//   [process_noise] distribution, health_sigma, accumulate, speed_sigma_percent (process_noise.h)
//   [[profile]] time_s, n1_rpm or net_thrust_n, altitude_m, mach, delta_isa_k, customer_bleed_kg_s, power_w
//   [[wear]] parameter, initial, drift_per_hour
//   [[health_change]] time_s, parameter, change, ramp_s
//   [[health_noise]] parameter, sigma
//   [[control_change]] time_s, control, change, ramp_s     (of a linear model)
//   [[sensor_fault]] time_s, sensor, kind, magnitude, duration_s
//
// @throws config::ConfigError with file, line, key, value, allowed range.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "deploy/runtime/config/schema.h"
#include "engine_sim/linear_model/linear_model.h"
#include "engine_sim/scenario/engine_keys.h"
#include "engine_sim/scenario/life_keys.h"
#include "engine_sim/scenario/mismatch_keys.h"
#include "engine_sim/scenario/mission_keys.h"
#include "engine_sim/scenario/process_noise_keys.h"
#include "engine_sim/scenario/scenario.h"

namespace ehm::engine_sim {

/// A recording or CSV file instead of a flight.
struct ReplayOptions {
  std::string file;        ///< empty: fly
  std::string column_map;  ///< of a CSV file
  std::string stamps = "original";
};

struct SimConfig {
  Scenario scenario;
  EngineKeys engine_keys;
  MismatchKeys mismatch_keys;
  MissionKeys mission_keys;
  LifeKeys life_keys;
  ProcessNoiseKeys process_noise_keys;
  ReplayOptions replay;
  std::string linear_file;  ///< file of a model to fly; empty: the turbofan flies
  /// What that file holds, once a table or finish_config has asked for it; null: the turbofan flies.
  std::shared_ptr<const linear_model::LinearModel> linear;
  std::string demand_kind = "t40_k";
  std::vector<std::optional<double>> profile_levers;  ///< percent, of each point of the profile
  std::string rate = "1";                             ///< times real time, or "max": lockstep with the monitor
  std::int64_t lockstep_window = 16;                  ///< samples that may be unanswered under "max"
  std::int64_t wait_for_monitors = 0;
  std::int64_t domain = 0;
  std::string partition, profiles_file, profile = "ehm_participant", security;
  bool security_required = false;
  std::string log_level = "info";

  /// Rate as a number; 0 for "max".
  double rate_factor() const;
};

/// Declares every key of `config`; load the schema, then call finish_config.
void declare(config::Schema& schema, SimConfig& config);
/// Checks what no single key can tell: demand kind, rate, order of the profile, what a linear model can fly. `schema`
/// has loaded `config`.
void finish_config(SimConfig& config, const config::Schema& schema);

}  // namespace ehm::engine_sim
