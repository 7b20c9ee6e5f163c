#include "engine_sim/sensors/sensor_suite.h"

#include <cmath>
#include <utility>

namespace ehm::engine_sim {

namespace {

struct Kind {
  double noise_percent, lag_s;
};

Kind kind_of(const SensorSuiteOptions& options, std::string_view unit) {
  if (unit == "rpm") return {options.noise_speed_percent, options.lag_speed_s};
  if (unit == "Pa") return {options.noise_pressure_percent, options.lag_pressure_s};
  return {options.noise_temperature_percent, options.lag_temperature_s};
}

SensorOptions sensor_options(const SensorSuiteOptions& options, std::size_t sensor, double trim) {
  const Kind kind = kind_of(options, sensor_names[sensor].unit);
  return {0.01 * kind.noise_percent * std::abs(trim), kind.lag_s, 0.01 * options.quantisation_percent * std::abs(trim)};
}

template <std::size_t... I>
std::array<Sensor, sizeof...(I)> make_sensors(const SensorSuiteOptions& options,
                                              const std::array<double, sizeof...(I)>& trim, std::index_sequence<I...>) {
  return {Sensor(sensor_options(options, I, trim[I]))...};
}

}  // namespace

std::array<double, sensor_count> true_sensors(const GasPath& gas) {
  return {gas.speeds.n1_rpm, gas.speeds.n2_rpm, gas.s24.pt_pa, gas.s24.tt_k, gas.ps_30_pa, gas.s30.tt_k, gas.s48.tt_k};
}

std::array<double, auxiliary_count> true_auxiliary(const GasPath& gas) {
  return {gas.s40.tt_k, gas.s50.tt_k, gas.net_thrust_n, gas.stall_margin_lpc_percent};
}

SensorSuite::SensorSuite(const SensorSuiteOptions& options, const std::array<double, sensor_count>& trim,
                         std::uint64_t seed)
    : sensors_(make_sensors(options, trim, std::make_index_sequence<sensor_count>())), noise_(seed) {
  for (std::size_t i = 0; i < sensor_count; ++i) sigma_[i] = sensor_options(options, i, trim[i]).noise_sigma;
}

std::array<Reading, sensor_count> SensorSuite::read(const GasPath& gas, double time_s, double dt_s) {
  const auto truth = true_sensors(gas);
  std::array<Reading, sensor_count> readings;
  for (std::size_t i = 0; i < sensor_count; ++i) readings[i] = sensors_[i].read(truth[i], time_s, dt_s, noise_);
  return readings;
}

}  // namespace ehm::engine_sim
