// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/sensor_costs.h"

#include <algorithm>
#include <set>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

using files::FileError;
using linear_model::Channel;

double cost_in(const std::string& text, const std::string& place) {
  const auto cost = files::parse_number(text);
  if (!cost || *cost < 0.0)
    throw FileError(place + ": cost is " + files::in_quotes(text) + "; allowed: a finite number, 0 or above");
  return *cost;
}

void read_file(const std::vector<Channel>& sensors, const std::string& path, std::vector<double>& costs) {
  const files::CsvTable table = files::read_csv(path);
  const auto name = table.column("sensor"), cost = table.column("cost");
  if (!name || !cost || table.header.cells.size() != 2)
    throw FileError(table.place(table.header) + ": the columns are to be sensor and cost");
  std::set<std::size_t> seen;
  for (const files::CsvRow& row : table.rows) {
    const std::size_t i = sensor_index(sensors, row.cells[*name], table.place(row));
    if (!seen.insert(i).second)
      throw FileError(table.place(row) + ": sensor " + files::in_quotes(row.cells[*name]) + " appears twice");
    costs[i] = cost_in(row.cells[*cost], table.place(row));
  }
}

}  // namespace

std::size_t sensor_index(const std::vector<Channel>& sensors, const std::string& name, const std::string& place) {
  const auto found = std::find_if(sensors.begin(), sensors.end(), [&](const Channel& s) { return s.name == name; });
  if (found != sensors.end()) return as_size(found - sensors.begin());
  std::string known;
  for (const Channel& sensor : sensors) known += (known.empty() ? "" : ", ") + sensor.name;
  throw FileError(place + ": unknown sensor " + files::in_quotes(name) + "; allowed: " + known);
}

std::vector<double> sensor_costs(const std::vector<Channel>& sensors, const std::vector<std::string>& texts) {
  std::vector<double> costs(sensors.size(), 1.0);
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos) {
      read_file(sensors, text, costs);
      continue;
    }
    const std::string place = "--cost " + text;
    costs[sensor_index(sensors, text.substr(0, equals), place)] = cost_in(text.substr(equals + 1), place);
  }
  return costs;
}

}  // namespace ehm::tuner_design
