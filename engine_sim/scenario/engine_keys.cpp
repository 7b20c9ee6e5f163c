// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/engine_keys.h"

#include <algorithm>
#include <optional>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/shipped_engines.h"

namespace ehm::engine_sim {
namespace {

struct SensorKey {
  const char* key;
  std::optional<double> SensorOverrides::*value;
  double shown;  ///< of the default engine
  double highest;
  const char *unit, *description;
};
using O = SensorOverrides;
constexpr SensorKey sensor_keys[] = {
    {"sensors.noise_speed_percent", &O::noise_speed_percent, 0.25, 20, "percent", "noise of the speeds, of trim"},
    {"sensors.noise_pressure_percent", &O::noise_pressure_percent, 0.5, 20, "percent",
     "noise of the pressures, of trim"},
    {"sensors.noise_temperature_percent", &O::noise_temperature_percent, 0.75, 20, "percent",
     "noise of the temperatures, of trim"},
    {"sensors.lag_speed_s", &O::lag_speed_s, 0, 10, "s", "first-order lag of the speeds (AGTF30: 0.02)"},
    {"sensors.lag_pressure_s", &O::lag_pressure_s, 0, 10, "s", "first-order lag of the pressures (AGTF30: 0.04)"},
    {"sensors.lag_temperature_s", &O::lag_temperature_s, 0, 10, "s",
     "first-order lag of the temperatures (AGTF30: 0.7)"},
    {"sensors.quantisation_percent", &O::quantisation_percent, 0, 5, "percent",
     "smallest step of a reading, of trim, in place of the engine's resolutions"}};

struct ControlKey {
  const char* key;
  double& (*of)(ControlData&);
  double lowest, highest;
  const char *unit, *description;
};
constexpr double slowest_fan_rpm = 500, fastest_fan_rpm = 30'000, slowest_core_rpm = 1000, fastest_core_rpm = 100'000;
constexpr ControlKey control_keys[] = {
    {"control.n1_max_rpm", [](ControlData& c) -> double& { return c.limits.n1_rpm; }, slowest_fan_rpm, fastest_fan_rpm,
     "rpm", "fan speed limit"},
    {"control.n1_corrected_max_rpm", [](ControlData& c) -> double& { return c.limits.n1_corrected_rpm; },
     slowest_fan_rpm, fastest_fan_rpm, "rpm", "limit of N1/sqrt(theta2)"},
    {"control.n2_max_rpm", [](ControlData& c) -> double& { return c.limits.n2_rpm; }, slowest_core_rpm,
     fastest_core_rpm, "rpm", "core speed limit"},
    {"control.n2_corrected_max_rpm", [](ControlData& c) -> double& { return c.limits.n2_corrected_rpm; },
     slowest_core_rpm, fastest_core_rpm, "rpm", "limit of N2/sqrt(theta2)"},
    {"control.t48_max_k", [](ControlData& c) -> double& { return c.limits.t48_k; }, 500, 2000, "K",
     "limit of the gas temperature behind the HPT"},
    {"control.ps30_max_pa", [](ControlData& c) -> double& { return c.limits.ps_30_pa; }, 1e5, 1e7, "Pa",
     "limit of the static pressure behind the HPC"},
    {"control.ground_idle_n2_corrected_rpm",
     [](ControlData& c) -> double& { return c.limits.ground_idle_n2_corrected_rpm; }, slowest_core_rpm,
     fastest_core_rpm, "rpm", "least core speed N2/sqrt(theta2) up to Mach 0.25 and 3000 m"},
    {"control.flight_idle_n2_corrected_rpm",
     [](ControlData& c) -> double& { return c.limits.flight_idle_n2_corrected_rpm; }, slowest_core_rpm,
     fastest_core_rpm, "rpm", "least core speed N2/sqrt(theta2) elsewhere"},
    {"control.speed_bandwidth_rad_s", [](ControlData& c) -> double& { return c.fuel.speed_bandwidth_rad_s; }, 0.1, 10,
     "rad/s", "how fast the speed loops close: a small error falls to 1/e in its inverse"}};

}  // namespace

void EngineKeys::declare(config::Schema& schema, Scenario& scenario) {
  schema.text("engine.model", model_,
              "the engine that flies: the name of a shipped one (" + shipped_engine_names() +
                  "), or an engine file. What is not given of [sensors] and [control] is what it says");
  schema.alias("engine.model", "--engine");
  static_assert(std::size(sensor_keys) == std::tuple_size_v<decltype(sensor_values_)>);
  for (std::size_t i = 0; i < sensor_values_.size(); ++i) {
    sensor_values_[i] = sensor_keys[i].shown;
    schema.real(sensor_keys[i].key, sensor_values_[i], 0, sensor_keys[i].highest, sensor_keys[i].unit,
                sensor_keys[i].description);
  }
  schema.choice("sensors.noise_of", noise_of_, {noise_of_names.begin(), noise_of_names.end()},
                "what the percents of noise are of: the values at the start, or what each sensor reads at the moment");
  schema.flag("control.hold_limits", scenario.control.hold_limits,
              "whether the control holds the limits below; its acceleration and deceleration schedules always act");
  for (const ControlKey& key : control_keys)
    schema.real(key.key, key.of(scenario.control), key.lowest, key.highest, key.unit, key.description);
}

void EngineKeys::take_engine(Scenario& scenario) {
  if (taken_) return;
  try {
    scenario.engine = named_engine(model_);
    taken_ = true;
  } catch (const files::FileError& error) {
    throw config::ConfigError(std::string("'engine.model': ") + error.what());
  }
}

void EngineKeys::finish(const std::vector<std::string>& given, Scenario& scenario) const {
  const auto is_given = [&](const char* key) { return std::find(given.begin(), given.end(), key) != given.end(); };
  for (std::size_t i = 0; i < sensor_values_.size(); ++i)
    if (is_given(sensor_keys[i].key)) scenario.sensors.*sensor_keys[i].value = sensor_values_[i];
  if (is_given("sensors.noise_of"))
    scenario.sensors.noise_of =
        noise_of_ == noise_of_names[as_size(NoiseOf::reading)] ? NoiseOf::reading : NoiseOf::trim;
  ControlData control = scenario.engine->control;
  control.hold_limits = scenario.control.hold_limits;
  for (const ControlKey& key : control_keys)
    if (is_given(key.key)) key.of(control) = key.of(scenario.control);
  scenario.control = control;
}

}  // namespace ehm::engine_sim
