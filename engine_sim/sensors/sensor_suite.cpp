// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/sensors/sensor_suite.h"

#include <cmath>

namespace ehm::engine_sim {

std::vector<SensorChannel> overridden(std::vector<SensorChannel> sensors, const SensorOverrides& o) {
  for (SensorChannel& sensor : sensors) {
    sensor.noise_of = o.noise_of.value_or(sensor.noise_of);
    const auto& unit = sensor.quantity->unit;
    const auto& noise = unit == "rpm"  ? o.noise_speed_percent
                        : unit == "Pa" ? o.noise_pressure_percent
                                       : o.noise_temperature_percent;
    const auto& lag = unit == "rpm" ? o.lag_speed_s : unit == "Pa" ? o.lag_pressure_s : o.lag_temperature_s;
    if (unit != "rpm" && unit != "Pa" && unit != "K") continue;
    sensor.noise_percent = noise.value_or(sensor.noise_percent);
    sensor.lag_s = lag.value_or(sensor.lag_s);
  }
  return sensors;
}

std::vector<double> true_sensors(const EngineDefinition& engine, const GasPath& gas) {
  std::vector<double> truth;
  for (const SensorChannel& sensor : engine.channels.sensors)
    truth.push_back(sensor.quantity->read(gas, engine.data.ratings));
  return truth;
}

std::vector<double> true_auxiliary(const EngineDefinition& engine, const GasPath& gas) {
  std::vector<double> truth;
  for (const OutputChannel* output : engine.channels.auxiliary) truth.push_back(output->read(gas, engine.data.ratings));
  return truth;
}

SensorSuite::SensorSuite(const std::vector<SensorChannel>& channels, const SensorOverrides& overrides,
                         std::span<const double> trim, std::uint64_t seed)
    : noise_(seed) {
  const std::vector<SensorChannel> flying = overridden(channels, overrides);
  for (std::size_t i = 0; i < flying.size(); ++i) {
    const double size = std::abs(trim[i]);
    sigma_.push_back(0.01 * flying[i].noise_percent * size);
    const double step =
        overrides.quantisation_percent ? 0.01 * *overrides.quantisation_percent * size : flying[i].resolution;
    SensorOptions options{.lag_s = flying[i].lag_s, .step = step};
    if (flying[i].noise_of == NoiseOf::trim)
      options.noise_sigma = sigma_[i];
    else
      options.noise_fraction = 0.01 * flying[i].noise_percent;
    sensors_.emplace_back(options);
  }
}

std::vector<Reading> SensorSuite::read(std::span<const double> truth, double time_s, double dt_s) {
  std::vector<Reading> readings;
  readings.reserve(sensors_.size());
  for (std::size_t i = 0; i < sensors_.size(); ++i)
    readings.push_back(sensors_[i].read(truth[i], time_s, dt_s, noise_));
  return readings;
}

}  // namespace ehm::engine_sim
