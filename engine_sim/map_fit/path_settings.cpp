// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/map_fit/path_settings.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/map_fit/checked_numbers.h"

namespace ehm::engine_sim {
namespace {

using files::JsonObject;
using files::shown;
using files::throw_defect;

/// Each point is a row of the least-squares system.
constexpr int most_points = 2000;

std::vector<std::pair<double, double>> read_r_line_by_speed(JsonObject& object) {
  const std::string name = "r_line_by_speed";
  const files::Json& list = object.array(name);
  if (list.empty() || list.size() > 100) {
    throw_defect(object.file(), object.key(name), std::to_string(list.size()) + " pairs long", "1 to 100 pairs [n, R]",
                 "Correct the list");
  }
  const Eigen::MatrixXd pairs = object.matrix(name, as_index(list.size()), 2);
  std::vector<std::pair<double, double>> points;
  for (const auto& pair : pairs.rowwise()) {
    if (!points.empty() && pair(0) <= points.back().first) {
      throw_defect(object.file(), object.key(name) + "[" + std::to_string(points.size()) + "][0]", shown(pair(0)),
                   "a speed above " + shown(points.back().first) + ", the one before",
                   "Put the pairs in ascending order");
    }
    points.emplace_back(pair(0), pair(1));
  }
  return points;
}

double r_line_at(const std::vector<std::pair<double, double>>& points, double speed) {
  const auto above = std::find_if(points.begin(), points.end(), [&](const auto& p) { return p.first >= speed; });
  if (above == points.begin()) return points.front().second;
  if (above == points.end()) return points.back().second;
  const auto& [n0, r0] = *std::prev(above);
  const auto& [n1, r1] = *above;
  return r0 + (r1 - r0) * ((speed - n0) / (n1 - n0));
}

int count_of_speeds(const PathSettings& s) {
  constexpr double rounding = 1e-6;  // of a whole number of steps
  return static_cast<int>(std::floor((s.speed_to - s.speed_from) / s.speed_step + rounding)) + 1;
}

}  // namespace

PathSettings read_path_settings(const files::Json& json, const std::string& file, const std::string& key) {
  JsonObject object(json, file, key);
  PathSettings s{};
  s.speed_from = number_between(object, "speed_from", 0.01, 3.0);
  s.speed_to = number_between(object, "speed_to", s.speed_from, 3.0);
  s.speed_step = number_between(object, "speed_step", 0.001, 1.0);
  s.r_line_by_speed = read_r_line_by_speed(object);
  s.r_line_extent = number_between(object, "r_line_extent", 0.0, 10.0);
  s.points_along = static_cast<int>(number_between(object, "points_along", 1.0, 100.0));
  if (s.points_along != object.number("points_along")) {
    throw_defect(file, object.key("points_along"), shown(object.at("points_along")), "a whole number from 1 to 100",
                 "Correct the value");
  }
  s.speed_per_r_line = number_between(object, "speed_per_r_line", -10.0, 10.0);
  s.r_line_step = number_between(object, "r_line_step", 0.001, 1.0);
  s.weight = number_between(object, "weight", 0.0, 1000.0);
  if (count_of_speeds(s) * s.points_along > most_points) {
    throw_defect(file, object.key("speed_step"), shown(s.speed_step),
                 "a step that gives at most " + std::to_string(most_points) + " points, instead of " +
                     std::to_string(count_of_speeds(s) * s.points_along),
                 "Take a wider step or fewer points_along");
  }
  if (object.find("why") != nullptr) object.text("why");
  object.refuse_unknown();
  return s;
}

StraightPath straight_path(const PathSettings& s) {
  StraightPath path{{}, s.speed_per_r_line * s.r_line_step, s.r_line_step, s.weight};
  for (int i = 0; i < count_of_speeds(s); ++i) {
    const double speed = s.speed_from + s.speed_step * i;
    const double r_line = r_line_at(s.r_line_by_speed, speed);
    for (int k = 0; k < s.points_along; ++k) {
      const double along = s.r_line_extent * k / std::max(1, s.points_along - 1);
      path.points.emplace_back(speed + s.speed_per_r_line * along, r_line + along);
    }
  }
  return path;
}

}  // namespace ehm::engine_sim
