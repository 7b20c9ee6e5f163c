#pragma once
// What one simulated flight is: condition and demand over time, wear, faults, sensors, seed. Plain data in SI units;
// scenario_file.h reads it from TOML.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine_sim/control/jt9d_control.h"
#include "engine_sim/model/gas_path.h"
#include "engine_sim/model/steady.h"
#include "engine_sim/sensors/sensor_suite.h"

namespace ehm::engine {

/// A point of the flight profile; between points every quantity is interpolated linearly, outside it is held.
struct ProfilePoint {
  double time_s = 0.0;
  FlightCondition flight;
  Demand demand{DemandKind::n1_rpm, 0.0};  ///< n1_rpm or net_thrust_n, the same kind in all points
};

/// Wear of one health parameter: h(t) = initial + drift t.
struct Wear {
  double initial = 0.0;
  double drift_per_s = 0.0;
};

/// A change of one health parameter that begins at time_s and takes ramp_s (0: at once).
struct HealthChange {
  double time_s = 0.0;
  std::size_t parameter = 0;
  double change = 0.0;
  double ramp_s = 0.0;
};

struct ScheduledFault {
  std::size_t sensor = 0;
  SensorFault fault;
};

struct Scenario {
  std::int64_t engine_id = 1;
  std::int64_t source_id = 1;
  std::string engine_type = "jt9d";
  double sample_time_s = 0.015;
  double duration_s = 0.0;  ///< 0: until stopped
  std::int64_t seed = 1;

  bool heat_soak = false;  ///< of the metal behind HPC, HPT and LPT
  Offtake offtake;         ///< what the aircraft takes all the time

  FlightCondition flight{10668.0, 0.8, 0.0};
  /// Demand for the new engine at the start; what it gives as fan speed is what the control holds for the worn one.
  Demand demand{DemandKind::t40_k, 1308.6};
  std::vector<ProfilePoint> profile;  ///< empty: the start is held

  std::array<Wear, health_count> wear{};
  std::vector<HealthChange> health_changes;
  std::vector<ScheduledFault> faults;
  SensorSuiteOptions sensors;
  ControlData control = jt9d_control();
};

}  // namespace ehm::engine
