#pragma once
// The seven sensors of the monitored engine and the four outputs that none of them measures, in the order of the wire.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "engine_sim/model/gas_path.h"
#include "engine_sim/sensors/sensor.h"

namespace ehm::engine_sim {

inline constexpr std::size_t sensor_count = 7;
inline constexpr std::size_t auxiliary_count = 4;

struct ChannelName {
  std::string_view name, unit;
};
inline constexpr std::array<ChannelName, sensor_count> sensor_names{
    {{"Nf", "rpm"}, {"Nc", "rpm"}, {"P24", "Pa"}, {"T24", "K"}, {"Ps30", "Pa"}, {"T30", "K"}, {"T48", "K"}}};
inline constexpr std::array<ChannelName, auxiliary_count> auxiliary_names{
    {{"T40", "K"}, {"T50", "K"}, {"Fn", "N"}, {"SmLPC", "percent"}}};

/// What a perfect sensor would read.
std::array<double, sensor_count> true_sensors(const GasPath& gas);
std::array<double, auxiliary_count> true_auxiliary(const GasPath& gas);

/// Noise as percent of trim, and lag, by kind of sensor ([SG] table 2 for the noise; lags of AGTF30).
struct SensorSuiteOptions {
  double noise_speed_percent = 0.25, noise_pressure_percent = 0.5, noise_temperature_percent = 0.75;
  double lag_speed_s = 0.0, lag_pressure_s = 0.0, lag_temperature_s = 0.0;
  double quantisation_percent = 0.0;  ///< of trim, every sensor
};

class SensorSuite {
 public:
  SensorSuite(const SensorSuiteOptions& options, const std::array<double, sensor_count>& trim, std::uint64_t seed);

  std::array<Reading, sensor_count> read(const GasPath& gas, double time_s, double dt_s);
  void inject(std::size_t sensor, const SensorFault& fault) { sensors_.at(sensor).inject(fault); }
  double noise_sigma(std::size_t sensor) const { return sigma_.at(sensor); }

 private:
  std::array<double, sensor_count> sigma_{};
  std::array<Sensor, sensor_count> sensors_;
  NoiseSource noise_;
};

}  // namespace ehm::engine_sim
