// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/map_json.h"

#include <string>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/json_fields.h"
#include "engine_sim/engines/map_check.h"

namespace ehm::engine_sim {
namespace {

using files::Json;
using files::JsonObject;

constexpr std::size_t most_breaks = 64;
constexpr std::size_t basis_excess = 2;  // basis functions of a spline more than break points

constexpr NumberField<CompressorMapData> compressor_fields[] = {
    {"flow_exponent", &CompressorMapData::flow_exponent, 0.1, 10.0, "power of speed"},
    {"pressure_exponent", &CompressorMapData::pressure_exponent, 0.1, 10.0, "power of speed"},
    {"last_r_line", &CompressorMapData::last_r_line, 1.0, 20.0, "R-line"}};
constexpr NumberField<TurbineMapData> turbine_fields[] = {
    {"choking_rate", &TurbineMapData::choking_rate, 0.1, 100.0, "1 per pressure ratio"}};

/// Row-major.
std::vector<double> surface_from(JsonObject& object, const char* key, std::size_t row_breaks,
                                 std::size_t column_breaks) {
  const Eigen::MatrixXd surface =
      object.matrix(key, as_index(row_breaks + basis_excess), as_index(column_breaks + basis_excess));
  std::vector<double> numbers;
  for (Eigen::Index i = 0; i < surface.rows(); ++i) {
    const Eigen::VectorXd row = surface.row(i);
    numbers.insert(numbers.end(), row.begin(), row.end());
  }
  return numbers;
}

Json surface_to_json(std::span<const double> numbers, std::size_t column_breaks) {
  const std::size_t columns = column_breaks + basis_excess;
  Json rows = Json::array();
  for (std::size_t first = 0; first < numbers.size(); first += columns) {
    const auto row = numbers.subspan(first, columns);
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}

Json list_to_json(std::span<const double> numbers) {
  return std::vector<double>(numbers.begin(), numbers.end());
}

}  // namespace

CompressorMap compressor_map_from(JsonObject& parent, const std::string& key) {
  JsonObject object(parent.at(key), parent.file(), parent.key(key));
  CompressorMapData data{};
  read_fields(object, compressor_fields, data);
  const auto speed = ascending_list(object, "speed_breaks", 2, most_breaks);
  const auto r_line = ascending_list(object, "r_line_breaks", 2, most_breaks);
  const auto flow = surface_from(object, "flow", speed.size(), r_line.size());
  const auto pressure = surface_from(object, "pressure", speed.size(), r_line.size());
  const auto efficiency = surface_from(object, "efficiency", speed.size(), r_line.size());
  const auto surge_flow = ascending_list(object, "surge_flow_breaks", 2, most_breaks);
  const std::size_t surge_size = surge_flow.size() + basis_excess;
  const auto surge_pressure_ratio = number_list(object, "surge_pressure_ratio", surge_size, surge_size);
  object.refuse_unknown();
  data.speed_breaks = speed, data.r_line_breaks = r_line;
  data.flow = flow, data.pressure = pressure, data.efficiency = efficiency;
  data.surge_flow_breaks = surge_flow, data.surge_pressure_ratio = surge_pressure_ratio;
  CompressorMap map(data);
  check_map(map, object);
  return map;
}

TurbineMap turbine_map_from(JsonObject& parent, const std::string& key) {
  JsonObject object(parent.at(key), parent.file(), parent.key(key));
  TurbineMapData data{};
  read_fields(object, turbine_fields, data);
  const auto speed = ascending_list(object, "speed_breaks", 2, most_breaks);
  const auto pressure_ratio = ascending_list(object, "pressure_ratio_breaks", 2, most_breaks);
  const auto flow = surface_from(object, "flow", speed.size(), pressure_ratio.size());
  const auto efficiency = surface_from(object, "efficiency", speed.size(), pressure_ratio.size());
  object.refuse_unknown();
  data.speed_breaks = speed, data.pressure_ratio_breaks = pressure_ratio;
  data.flow = flow, data.efficiency = efficiency;
  TurbineMap map(data);
  check_map(map, object);
  return map;
}

Json to_json(const CompressorMap& map) {
  const CompressorMapData& data = map.data();
  Json json = json_of(compressor_fields, data);
  json["speed_breaks"] = list_to_json(data.speed_breaks);
  json["r_line_breaks"] = list_to_json(data.r_line_breaks);
  json["flow"] = surface_to_json(data.flow, data.r_line_breaks.size());
  json["pressure"] = surface_to_json(data.pressure, data.r_line_breaks.size());
  json["efficiency"] = surface_to_json(data.efficiency, data.r_line_breaks.size());
  json["surge_flow_breaks"] = list_to_json(data.surge_flow_breaks);
  json["surge_pressure_ratio"] = list_to_json(data.surge_pressure_ratio);
  return json;
}

Json to_json(const TurbineMap& map) {
  const TurbineMapData& data = map.data();
  Json json = json_of(turbine_fields, data);
  json["speed_breaks"] = list_to_json(data.speed_breaks);
  json["pressure_ratio_breaks"] = list_to_json(data.pressure_ratio_breaks);
  json["flow"] = surface_to_json(data.flow, data.pressure_ratio_breaks.size());
  json["efficiency"] = surface_to_json(data.efficiency, data.pressure_ratio_breaks.size());
  return json;
}

}  // namespace ehm::engine_sim
