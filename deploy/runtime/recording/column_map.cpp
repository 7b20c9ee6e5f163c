// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/column_map.h"

#include <algorithm>
#include <map>

#include "deploy/runtime/config/schema.h"
#include "deploy/runtime/config/table_reader.h"
#include "deploy/runtime/recording/row.h"
#include "deploy/runtime/units/units.h"

namespace ehm::recording {

using config::ConfigError;
using config::TableReader;

namespace {

constexpr std::int64_t last_column = 10'000;
constexpr double largest = 1e12;

Column read_column(TableReader& table, const std::string& key, bool header) {
  if (header && table.is_text(key)) return table.text(key);
  return static_cast<std::size_t>(table.integer(key, 1, last_column));
}

files::Separator read_separator(TableReader& table) {
  using files::Separator;
  const std::map<std::string, Separator> known{{"comma", Separator::comma},
                                               {"semicolon", Separator::semicolon},
                                               {"tab", Separator::tab},
                                               {"blank", Separator::blank}};
  return known.at(table.choice("separator", {"comma", "semicolon", "tab", "blank"}));
}

void read_file_table(TableReader& table, ColumnMap& map) {
  map.separator = read_separator(table);
  map.header = table.flag("header");
  if (table.has("decimal")) map.decimal = table.choice("decimal", {"point", "comma"}) == "comma" ? ',' : '.';
  map.engine_id_constant = table.has("engine_id");
  if (map.engine_id_constant)
    map.engine_id = static_cast<std::uint32_t>(table.integer("engine_id", 1, 4294967295));
  else
    map.engine_id_column = read_column(table, "engine_id_column", map.header);
  map.equidistant = table.has("sample_time_s");
  if (map.equidistant) {
    map.sample_time_s = table.real("sample_time_s", 1e-6, 1e6);
  } else {
    map.time_column = read_column(table, "time_column", map.header);
    map.seconds_per_unit = table.real_or("seconds_per_unit", 1.0, 1e-9, 1e6);
    map.time_may_repeat = table.has("time_may_repeat") && table.flag("time_may_repeat");
  }
  table.finish();
}

MappedChannel read_channel(TableReader& table, bool header) {
  MappedChannel channel;
  channel.name = table.text("name");
  channel.unit = table.text_or("unit", "");
  channel.constant = table.has("value");
  if (channel.constant) {
    channel.value = table.real("value", -largest, largest);
  } else {
    channel.column = read_column(table, "column", header);
    channel.factor = table.real_or("factor", 1.0, -largest, largest);
    channel.offset = table.real_or("offset", 0.0, -largest, largest);
  }
  table.finish();
  return channel;
}

/// One of the arrays of tables; names must differ, and there may be as many as the wire carries.
std::vector<MappedChannel> read_channels(const std::string& file, const toml::table& root, const std::string& key,
                                         std::size_t most, bool header) {
  const toml::array* array = root[key].as_array();
  const std::string allowed = ", allowed are 1 to " + std::to_string(most) + " tables [[" + key + "]]";
  if (!array || !array->is_array_of_tables()) throw ConfigError(file + ": '" + key + "' is missing" + allowed);
  if (array->size() > most)
    throw ConfigError(config::where(file, *array) + ": " + std::to_string(array->size()) + " of '" + key + "'" +
                      allowed);
  std::vector<MappedChannel> channels;
  for (const auto& element : *array) {
    TableReader table(file, key, *element.as_table());
    channels.push_back(read_channel(table, header));
    const auto same = [&](const MappedChannel& c) { return c.name == channels.back().name; };
    if (std::find_if(channels.begin(), channels.end() - 1, same) != channels.end() - 1)
      throw ConfigError(table.place() + ": '" + key + ".name' is '" + channels.back().name +
                        "' for the second time, allowed is once");
  }
  return channels;
}

/// A flight channel in the unit that its name says: what the file has, converted.
void convert_flight(const std::string& file, MappedChannel& channel, const char* unit, bool difference) {
  if (channel.unit.empty()) {
    channel.unit = unit;
    return;
  }
  const auto conversion = units::conversion(channel.unit, unit);
  if (!conversion)
    throw ConfigError(file + ": [[flight]] '" + channel.name + "' has the unit '" + channel.unit + "', needed is '" +
                      unit + "' or one that converts to it: " + units::why_not(channel.unit, unit));
  const units::Conversion use = difference ? conversion->of_differences() : *conversion;
  channel.factor *= use.factor;
  channel.offset = use(channel.offset);
  channel.value = use(channel.value);
  channel.unit = unit;
}

/// In the order of the wire, whatever the file's order.
void order_flight(const std::string& file, std::vector<MappedChannel>& flight) {
  std::vector<MappedChannel> ordered;
  for (const char* name : {"altitude_m", "mach", "delta_isa_k"}) {
    const auto found = std::find_if(flight.begin(), flight.end(), [&](const auto& c) { return c.name == name; });
    if (found == flight.end())
      throw ConfigError(file + ": [[flight]] '" + name + "' is missing; give it a column, or a constant value");
    ordered.push_back(*found);
  }
  if (flight.size() != ordered.size())
    throw ConfigError(file + ": [[flight]] has " + std::to_string(flight.size()) +
                      " tables, allowed are altitude_m, mach, delta_isa_k");
  flight = std::move(ordered);
  convert_flight(file, flight[0], "m", false);
  convert_flight(file, flight[1], "-", false);
  convert_flight(file, flight[2], "K", true);  // a difference of temperatures
}

}  // namespace

ColumnMap read_column_map(const std::string& file) {
  const toml::table root = config::parse_toml_file(file);
  const std::vector<std::string> known{"file", "flight", "actuator", "sensor"};
  for (const auto& [name, node] : root) {
    const std::string key(name.str());
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw ConfigError(config::where(file, node) + ": unknown key '" + key +
                        "', allowed are file, flight, actuator, sensor");
  }
  const toml::table* file_table = root["file"].as_table();
  if (!file_table) throw ConfigError(file + ": table [file] is missing");
  ColumnMap map;
  TableReader reader(file, "file", *file_table);
  read_file_table(reader, map);
  map.flight = read_channels(file, root, "flight", flight_channels, map.header);
  order_flight(file, map.flight);
  // A model without controls needs none.
  if (root.contains("actuator")) map.actuators = read_channels(file, root, "actuator", max_actuators, map.header);
  map.sensors = read_channels(file, root, "sensor", max_sensors, map.header);
  return map;
}

}  // namespace ehm::recording
