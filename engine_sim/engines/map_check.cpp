// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/map_check.h"

#include <string>

#include "engine_sim/engines/json_fields.h"

namespace ehm::engine_sim {
namespace {

using files::JsonObject;
using files::shown;

constexpr double waviness = 0.005;  // relative, of a fit where its surface is flat

/// Demands on the values of one map, named by place.
class MapChecker {
 public:
  explicit MapChecker(const JsonObject& object) : object_(object) {}

  void grows(const char* surface, double before, double after, const std::string& place) const {
    if (!(after > before)) refuse(surface, before, after, place, "more than that");
  }
  void does_not_fall(const char* surface, double before, double after, const std::string& place) const {
    if (!(after > before * (1.0 - waviness))) refuse(surface, before, after, place, "no less than that");
  }
  void falls(const char* surface, double before, double after, const std::string& place) const {
    if (!(after < before)) refuse(surface, before, after, place, "less than that");
  }
  void within(const char* surface, double value, double above, double most, const std::string& place) const {
    if (value > above && value <= most) return;
    throw_field_defect(object_, surface, shown(value) + " at " + place, "above " + shown(above) + " to " + shown(most),
                       "Fit the map again");
  }

 private:
  [[noreturn]] void refuse(const char* surface, double before, double after, const std::string& place,
                           const std::string& allowed) const {
    throw_field_defect(object_, surface, shown(after) + " after " + shown(before) + " at " + place, allowed,
                       "Fit the map again");
  }

  const JsonObject& object_;
};

std::string at_speed(double speed, const char* other, double value) {
  return "speed " + shown(speed) + ", " + other + " " + shown(value);
}

void check_speed_line(const CompressorMap& map, double speed, const MapChecker& check) {
  const auto r_lines = map.data().r_line_breaks;
  for (std::size_t j = 0; j < r_lines.size(); ++j) {
    const std::string place = at_speed(speed, "R-line", r_lines[j]);
    const auto point = map.at(speed, r_lines[j]);
    check.within("flow", point.flow, 0.0, 1e6, place);
    check.within("efficiency", point.efficiency, 0.0, 1.0, place);
    if (j > 0) check.does_not_fall("flow", map.at(speed, r_lines[j - 1]).flow, point.flow, place);
  }
  check.falls("pressure", map.at(speed, r_lines.front()).pressure_ratio, map.at(speed, r_lines.back()).pressure_ratio,
              at_speed(speed, "R-line", r_lines.back()));
}

}  // namespace

void check_map(const CompressorMap& map, const JsonObject& object) {
  const MapChecker check(object);
  const CompressorMapData& data = map.data();
  for (std::size_t i = 0; i < data.speed_breaks.size(); ++i) {
    const double speed = data.speed_breaks[i];
    if (!(speed > 0.0))
      throw_field_defect(object, "speed_breaks[" + std::to_string(i) + "]", shown(speed), "above 0",
                         "Correct the value");
    check_speed_line(map, speed, check);
    for (const double r_line : data.r_line_breaks) {
      if (i == 0) continue;
      const auto slower = map.at(data.speed_breaks[i - 1], r_line), point = map.at(speed, r_line);
      check.grows("flow", slower.flow, point.flow, at_speed(speed, "R-line", r_line));
      check.does_not_fall("pressure", slower.pressure_ratio, point.pressure_ratio, at_speed(speed, "R-line", r_line));
    }
  }
  double before = 1.0;
  for (const double flow : data.surge_flow_breaks) {
    const double pressure_ratio = map.surge_pressure_ratio(flow);
    check.grows("surge_pressure_ratio", before, pressure_ratio, "flow " + shown(flow));
    before = pressure_ratio;
  }
}

void check_map(const TurbineMap& map, const JsonObject& object) {
  const MapChecker check(object);
  const auto pressure_ratios = map.data().pressure_ratio_breaks;
  if (!(pressure_ratios.front() > 1.0))
    throw_field_defect(object, "pressure_ratio_breaks[0]", shown(pressure_ratios.front()), "above 1",
                       "Correct the value");
  for (const double speed : map.data().speed_breaks) {
    for (std::size_t j = 0; j < pressure_ratios.size(); ++j) {
      const std::string place = at_speed(speed, "pressure ratio", pressure_ratios[j]);
      const auto point = map.at(speed, pressure_ratios[j]);
      check.within("flow", point.flow, 0.0, 1e6, place);
      check.within("efficiency", point.efficiency, 0.0, 1.0, place);
      if (j > 0) check.does_not_fall("flow", map.at(speed, pressure_ratios[j - 1]).flow, point.flow, place);
    }
  }
}

}  // namespace ehm::engine_sim
