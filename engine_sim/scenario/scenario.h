// SPDX-License-Identifier: Apache-2.0
#pragma once
// What one simulated flight is: condition and demand over time, wear, faults, sensors, seed. Plain data in SI units;
// scenario_file.h reads it from TOML.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine_sim/disturbance/process_noise.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/mismatch/mismatch.h"
#include "engine_sim/model/gas_path.h"
#include "engine_sim/model/solve/steady.h"
#include "engine_sim/sensors/sensor_suite.h"

namespace ehm::engine_sim {

/// A point of the flight profile; between points every quantity is interpolated linearly, outside it is held.
struct ProfilePoint {
  double time_s = 0.0;
  FlightCondition flight{};
  Demand demand{DemandKind::n1_rpm, 0.0};  ///< n1_rpm or net_thrust_n, the same kind in all points
  Offtake offtake{};                       ///< what the aircraft takes
};

/// Wear of one health parameter: h(t) = initial + drift t.
struct Wear {
  double initial = 0.0;
  double drift_per_s = 0.0;
};

/// Between which a scenario or an order may bring a health parameter, as a fraction of nominal.
inline constexpr double health_min = -0.30, health_max = 0.10;

/// A change of one channel, a health parameter or a control, that begins at time_s and takes ramp_s (0: at once).
struct PlannedChange {
  double time_s = 0.0;
  std::size_t channel = 0;
  double change = 0.0;
  double ramp_s = 0.0;
};

/// What the changes of one channel have added by then: sum of change * clamp((t - time_s) / ramp_s, 0, 1).
inline double sum_of(const std::vector<PlannedChange>& changes, std::size_t channel, double t_s) {
  double sum = 0.0;
  for (const PlannedChange& c : changes)
    if (c.channel == channel && t_s >= c.time_s)
      sum += c.change * (c.ramp_s > 0.0 ? std::min(1.0, (t_s - c.time_s) / c.ramp_s) : 1.0);
  return sum;
}

struct ScheduledFault {
  std::size_t sensor = 0;
  SensorFault fault;
};

struct Scenario {
  std::int64_t engine_id = 1;
  std::int64_t source_id = 1;
  std::shared_ptr<const EngineDefinition> engine = default_engine();
  double sample_time_s = 0.015;
  double duration_s = 0.0;  ///< 0: until stopped
  std::int64_t seed = 1;

  bool heat_soak = false;  ///< of the metal behind HPC, HPT and LPT
  Offtake offtake;         ///< what the aircraft takes at the start, and where the profile says nothing else
  Mismatch mismatch{};     ///< of the engine that flies and of what is reported, from the file and the truth

  FlightCondition flight{10668.0, 0.8, 0.0};
  /// Demand for the new engine at the start; what it gives as fan speed is what the control holds for the worn one.
  Demand demand{DemandKind::t40_k, 1308.6};
  std::vector<ProfilePoint> profile;  ///< empty: the start is held

  std::vector<Wear> wear = std::vector<Wear>(health_count);  ///< by health parameter, in the order of gas_path.h
  std::vector<PlannedChange> health_changes;
  ProcessNoise process_noise;                  ///< off unless it is set
  std::vector<PlannedChange> control_changes;  ///< of a linear model's controls
  std::vector<ScheduledFault> faults;
  SensorOverrides sensors;
  ControlData control = engine->control;  ///< as the flight sets it
};

}  // namespace ehm::engine_sim
