// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where a fitted surface is kept straight (StraightPath of fit_surface.h), as a compact description. One path starts on
// each of the speeds n0 = speed_from, speed_from + speed_step, ... up to speed_to, at the R-line R0(n0), piecewise
// linear in r_line_by_speed = [[n, R], ...] and constant beyond its ends. From there it runs over r_line_extent in
// `points_along` equally spaced points:
//   R = R0 + s,  n = n0 + speed_per_r_line s,  s = 0 ... r_line_extent
// At each point the second difference over (speed_per_r_line r_line_step, r_line_step) is punished with `weight`.
// Units: n is a fraction of the design speed, R as in the table; weight is relative to samples of weight 1 (for flow:
// to relative errors). Typical: the working line and the way on which wear moves an engine off it.

#include <string>
#include <utility>
#include <vector>

#include "deploy/runtime/files/json_object.h"
#include "engine_sim/map_fit/fit_surface.h"

namespace ehm::engine_sim {

struct PathSettings {
  double speed_from, speed_to, speed_step;
  std::vector<std::pair<double, double>> r_line_by_speed;  ///< (n, R), n ascending
  double r_line_extent;
  int points_along;
  double speed_per_r_line;  ///< direction
  double r_line_step;       ///< of the second difference
  double weight;
};

/// Ranges: path_settings.cpp; at most 2000 points in all. @throws files::FileError naming file, key, value and allowed
/// range
PathSettings read_path_settings(const files::Json& json, const std::string& file, const std::string& key);

StraightPath straight_path(const PathSettings& settings);

}  // namespace ehm::engine_sim
