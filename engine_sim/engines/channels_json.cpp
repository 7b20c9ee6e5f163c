// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/channels_json.h"

#include <algorithm>
#include <set>

#include "engine_sim/engines/json_fields.h"

namespace ehm::engine_sim {
namespace {

using files::Json;
using files::JsonObject;

constexpr std::size_t most_sensors = 16, most_auxiliary = 8, most_controls = 8;
constexpr double largest_noise_percent = 20.0, largest_lag_s = 10.0, largest_sigma = 0.2;

const Json& list_of(JsonObject& channels, const char* key, std::size_t least, std::size_t most) {
  const Json& array = channels.array(key);
  if (array.size() < least || array.size() > most)
    throw_field_defect(channels, key, std::to_string(array.size()) + " long",
                       std::to_string(least) + " to " + std::to_string(most) + " channels", "Correct the list");
  return array;
}

std::string place(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "]";
}

/// The channel of this name; `taken` are the names before it.
template <class Find>
auto channel_of(const JsonObject& channels, const std::string& key, const std::string& name, Find find,
                const std::string& known, std::set<std::string>& taken) {
  if (!taken.insert(name).second)
    throw_field_defect(channels, key, "\"" + name + "\" again", "each name once", "Remove one of them");
  if (const auto* channel = find(name)) return channel;
  throw_field_defect(channels, key, "\"" + name + "\"", known, "Correct the name");
}

/// A list of bare names.
template <class Channel, class Find>
std::vector<const Channel*> named(JsonObject& channels, const char* list, std::size_t least, std::size_t most,
                                  Find find, const std::string& known) {
  std::vector<const Channel*> result;
  std::set<std::string> taken;
  const Json& array = list_of(channels, list, least, most);
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (!array[i].is_string())
      throw_field_defect(channels, place(list, i), files::shown(array[i]), "a name in quotes", "Write it in quotes");
    result.push_back(channel_of(channels, place(list, i), array[i].get<std::string>(), find, known, taken));
  }
  return result;
}

double optional_number(JsonObject& entry, const char* key, double highest, const std::string& unit) {
  if (entry.find(key) == nullptr) return 0.0;
  const double value = entry.number(key);
  require_within(entry, key, value, 0.0, highest, unit);
  return value;
}

NoiseOf noise_of(JsonObject& entry) {
  if (entry.find("noise_of") == nullptr) return NoiseOf::trim;
  const std::string name = entry.text("noise_of");
  const auto found = std::find(noise_of_names.begin(), noise_of_names.end(), name);
  if (found == noise_of_names.end())
    throw_field_defect(entry, "noise_of", "\"" + name + "\"", "trim or reading", "Correct the name");
  return static_cast<NoiseOf>(found - noise_of_names.begin());
}

std::vector<SensorChannel> sensors_from(JsonObject& channels) {
  std::vector<SensorChannel> sensors;
  std::set<std::string> taken;
  const Json& array = list_of(channels, "sensors", 1, most_sensors);
  for (std::size_t i = 0; i < array.size(); ++i) {
    JsonObject entry(array[i], channels.file(), channels.key(place("sensors", i)));
    const OutputChannel* quantity = channel_of(entry, "name", entry.text("name"), find_output, output_names(), taken);
    SensorChannel sensor{quantity, entry.number("noise_percent")};
    require_within(entry, "noise_percent", sensor.noise_percent, 0.0, largest_noise_percent, "percent");
    sensor.noise_of = noise_of(entry);
    sensor.lag_s = optional_number(entry, "lag_s", largest_lag_s, "s");
    sensor.resolution = optional_number(entry, "resolution", 1e6, std::string(quantity->unit));
    entry.refuse_unknown();
    sensors.push_back(sensor);
  }
  return sensors;
}

std::vector<HealthChannel> health_from(JsonObject& channels) {
  std::vector<HealthChannel> health;
  std::set<std::string> taken;
  const auto find = [](const std::string& name) {
    const std::size_t i = find_health(name);
    return i < health_count ? &health_names[i] : nullptr;
  };
  const Json& array = list_of(channels, "health", 1, health_count);
  for (std::size_t i = 0; i < array.size(); ++i) {
    JsonObject entry(array[i], channels.file(), channels.key(place("health", i)));
    const auto* name = channel_of(entry, "name", entry.text("name"), find, health_parameter_names(), taken);
    const double sigma = entry.number("sigma");
    require_within(entry, "sigma", sigma, 1e-6, largest_sigma, "fraction");
    entry.refuse_unknown();
    health.push_back({static_cast<Health>(name - health_names.data()), sigma});
  }
  return health;
}

}  // namespace

NamedChannels channels_from(JsonObject& root) {
  JsonObject object(root.at("channels"), root.file(), root.key("channels"));
  NamedChannels channels{
      sensors_from(object), named<OutputChannel>(object, "auxiliary", 0, most_auxiliary, find_output, output_names()),
      named<ControlChannel>(object, "controls", 1, most_controls, find_control, control_names()), health_from(object)};
  object.refuse_unknown();
  const auto& controls = channels.controls;
  if (std::none_of(controls.begin(), controls.end(), [](const auto* c) { return c->name == "fuel_flow"; }))
    throw_field_defect(object, "controls", files::shown(object.at("controls")), "a list with fuel_flow", "Add it");
  return channels;
}

Json to_json(const NamedChannels& channels) {
  Json sensors = Json::array(), auxiliary = Json::array(), controls = Json::array(), health = Json::array();
  for (const SensorChannel& sensor : channels.sensors) {
    sensors.push_back({{"name", sensor.quantity->name},
                       {"noise_percent", sensor.noise_percent},
                       {"lag_s", sensor.lag_s},
                       {"resolution", sensor.resolution}});
    if (sensor.noise_of != NoiseOf::trim) sensors.back()["noise_of"] = noise_of_names[as_size(sensor.noise_of)];
  }
  for (const OutputChannel* output : channels.auxiliary) auxiliary.push_back(output->name);
  for (const ControlChannel* control : channels.controls) controls.push_back(control->name);
  for (const HealthChannel& h : channels.health)
    health.push_back({{"name", health_names[h.parameter]}, {"sigma", h.sigma}});
  return {{"sensors", sensors}, {"auxiliary", auxiliary}, {"controls", controls}, {"health", health}};
}

}  // namespace ehm::engine_sim
