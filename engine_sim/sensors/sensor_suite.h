// SPDX-License-Identifier: Apache-2.0
#pragma once
// The sensors of the engine that flies, in the order of its file, which is that of the wire.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/sensors/sensor.h"

namespace ehm::engine_sim {

/// What a flight states in place of the engine file, by kind of sensor: rpm, Pa, K. A sensor of another kind keeps what
/// its file says.
struct SensorOverrides {
  std::optional<double> noise_speed_percent, noise_pressure_percent, noise_temperature_percent;
  std::optional<double> lag_speed_s, lag_pressure_s, lag_temperature_s;
  std::optional<double> quantisation_percent;  ///< of trim, every sensor; in place of its resolution
  std::optional<NoiseOf> noise_of;             ///< every sensor
};

/// The sensors as they fly.
std::vector<SensorChannel> overridden(std::vector<SensorChannel> sensors, const SensorOverrides& overrides);

/// What perfect sensors would read, or the engine's unmeasured outputs.
std::vector<double> true_sensors(const EngineDefinition& engine, const GasPath& gas);
std::vector<double> true_auxiliary(const EngineDefinition& engine, const GasPath& gas);

class SensorSuite {
 public:
  /// `trim`: of each sensor, what its percents refer to.
  SensorSuite(const std::vector<SensorChannel>& channels, const SensorOverrides& overrides,
              std::span<const double> trim, std::uint64_t seed);

  /// `truth`: of each sensor.
  std::vector<Reading> read(std::span<const double> truth, double time_s, double dt_s);
  void inject(std::size_t sensor, const SensorFault& fault) { sensors_.at(sensor).inject(fault); }
  double noise_sigma(std::size_t sensor) const { return sigma_.at(sensor); }

 private:
  std::vector<double> sigma_;
  std::vector<Sensor> sensors_;
  NoiseSource noise_;
};

}  // namespace ehm::engine_sim
