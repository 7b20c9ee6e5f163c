// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/mission_keys.h"

#include <algorithm>

#include "engine_sim/engines/sensor_lags.h"
#include "engine_sim/scenario/recorded_mission.h"

namespace ehm::engine_sim {

void MissionKeys::declare(config::Schema& schema) {
  schema.choice("mission.name", name_, {"none", "two_hours"},
                "a whole flight to fly: taxi, take-off, climb, two cruise levels, idle descent, approach, taxi");
  schema.alias("mission.name", "--mission");
  schema.text(
      "mission.file", file_,
      "a flight that an aircraft has flown, as a table (CSV): time_s, altitude, speed, and fan speed or fuel flow "
      "(recorded_mission.h); in place of mission.name");
  schema.real("mission.time_scale", options_.time_scale, 0.02, 10, "",
              "times its two hours; below 1 it is compressed, and its slams are as much steeper");
  schema.real("mission.delta_isa_k", options_.delta_isa_k, -40, 40, "K", "all along the flight");
  schema.real("mission.offtake", options_.offtake, 0, 3, "", "times its customer bleed and shaft power");
  schema.real("mission.power", options_.power, 0.8, 1.1, "", "times its fan speeds above idle");
}

void MissionKeys::finish(const std::vector<std::string>& given, Scenario& scenario) const {
  if (name_ == "none" && file_.empty()) return;
  if (name_ != "none" && !file_.empty())
    throw config::ConfigError("'mission.file' is '" + file_ + "', but 'mission.name' is '" + name_ +
                              "': leave one of the two out");
  const std::string which = file_.empty() ? name_ : file_;
  const auto is_given = [&](const std::string& key) {
    return std::find(given.begin(), given.end(), key) != given.end();
  };
  if (!scenario.profile.empty())
    throw config::ConfigError("the mission is '" + which + "', but there is a 'profile' too: leave one of the two out");
  for (const char* key : {"demand.kind", "demand.value", "flight.altitude_m", "flight.mach", "flight.delta_isa_k"})
    if (is_given(key))
      throw config::ConfigError("'" + std::string(key) + "' is given, but the mission '" + which +
                                "' has its own: leave one of the two out");
  scenario.profile = file_.empty() ? two_hour_mission(scenario.engine->data, options_)
                                   : recorded_mission(file_, *scenario.engine, options_);
  scenario.flight = scenario.profile.front().flight;
  scenario.demand = scenario.profile.front().demand;
  if (!is_given("engine.heat_soak")) scenario.heat_soak = true;
  if (!is_given("run.duration_s")) scenario.duration_s = scenario.profile.back().time_s;
  SensorOverrides& sensors = scenario.sensors;
  if (!sensors.noise_of) sensors.noise_of = NoiseOf::reading;
  const SensorLags lags;
  if (!sensors.lag_speed_s) sensors.lag_speed_s = lags.speed_s;
  if (!sensors.lag_pressure_s) sensors.lag_pressure_s = lags.pressure_s;
  if (!sensors.lag_temperature_s) sensors.lag_temperature_s = lags.temperature_s;
}

}  // namespace ehm::engine_sim
