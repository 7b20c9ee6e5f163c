// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/map_fit/compressor_fit.h"

#include <algorithm>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/map_fit/break_range.h"
#include "engine_sim/map_fit/deviation.h"
#include "engine_sim/map_fit/fit_surface.h"

namespace ehm::engine_sim {
namespace {

using Numbers = std::vector<double>;

void check_corner(const SettingsPlace& place, const Corner& corner, const Numbers& speed) {
  const auto inner = std::find(speed.begin() + 1, speed.end() - 1, corner.at);
  if (inner == speed.end() - 1) {
    std::string lines;
    for (auto n = speed.begin() + 1; n != speed.end() - 1; ++n) lines += (lines.empty() ? "" : ", ") + files::shown(*n);
    files::throw_defect(place.file, place.key + ".corner.at", files::shown(corner.at),
                        "a speed line of the table but its first and last: " + lines, "Correct the value");
  }
  if (corner.moved_to > corner.at && corner.moved_to < speed.back()) return;
  files::throw_defect(
      place.file, place.key + ".corner.moved_to", files::shown(corner.moved_to),
      "above " + files::shown(corner.at) + " and below " + files::shown(speed.back()) + ", the table's highest speed",
      "Correct the value");
}

CompressorTarget checked_target(const CompressorSettings& s, const CompressorTable& table) {
  if (s.corner) check_corner(s.place, *s.corner, table.speed);
  const CompressorTarget target =
      fit_target(s.corner ? move_corner(table, *s.corner) : table, s.flow_exponent, s.pressure_exponent);
  check_breaks(s.place, "speed_breaks", s.speed_breaks, target.speed.front(), target.speed.back());
  check_breaks(s.place, "r_line_breaks", s.r_line_breaks, target.r_line.front(), target.r_line.back());
  check_breaks(s.place, "surge_flow_breaks", s.surge_flow_breaks, table.flow.col(0).minCoeff(),
               table.flow.col(0).maxCoeff());
  return target;
}

}  // namespace

CompressorFit fit_compressor(const CompressorSettings& s, const CompressorTable& table) {
  const CompressorTarget t = checked_target(s, table);
  const double size = t.phi.mean();
  StraightPath flow_path = s.straight_flow ? straight_path(*s.straight_flow) : StraightPath{};
  flow_path.weight /= size;
  const StraightPath efficiency_path = s.straight_efficiency ? straight_path(*s.straight_efficiency) : StraightPath{};
  CompressorFit fit;
  fit.flow = fit_surface(t.speed, t.r_line, t.phi, t.flow_weight, s.speed_breaks, s.r_line_breaks,
                         map_smoothing / (size * size), flow_path);
  fit.pressure =
      fit_surface(t.speed, t.r_line, t.psi, t.pressure_weight, s.speed_breaks, s.r_line_breaks, map_smoothing);
  fit.efficiency = fit_surface(t.speed, t.r_line, t.efficiency, t.efficiency_weight, s.speed_breaks, s.r_line_breaks,
                               map_smoothing, efficiency_path);
  const Eigen::VectorXd surge_flow = table.flow.col(0), surge_pressure = table.pressure_ratio.col(0);
  fit.surge = fit_curve(Numbers(surge_flow.begin(), surge_flow.end()),
                        Numbers(surge_pressure.begin(), surge_pressure.end()), s.surge_flow_breaks, map_smoothing);
  fit.last_r_line = table.r_line.back();
  return fit;
}

engine_sim::CompressorMapData map_data(const CompressorSettings& s, const CompressorFit& fit) {
  return {s.flow_exponent, s.pressure_exponent, s.speed_breaks,      s.r_line_breaks, fit.flow,
          fit.pressure,    fit.efficiency,      s.surge_flow_breaks, fit.surge,       fit.last_r_line};
}

std::string deviation_text(const CompressorSettings& s, const CompressorFit& fit, const CompressorTable& table) {
  const engine_sim::CompressorMap fitted(map_data(s, fit));
  const Eigen::MatrixXd &wc = table.flow, &pr = table.pressure_ratio, &eff = table.efficiency;
  Deviation flow, pressure, efficiency, surge;
  for (Eigen::Index i = 0; i < wc.rows(); ++i) {
    surge.add(100.0 * (fitted.surge_pressure_ratio(wc(i, 0)) / pr(i, 0) - 1.0));
    for (Eigen::Index j = 0; j < wc.cols(); ++j) {
      const double r_line = table.r_line[as_size(j)];
      if (sample_weight(r_line, pr(i, j), eff(i, j)) < 1.0) continue;
      const auto at = fitted.at(table.speed[as_size(i)], r_line);
      flow.add(100.0 * (at.flow / wc(i, j) - 1.0));
      pressure.add(100.0 * (at.pressure_ratio / pr(i, j) - 1.0));
      efficiency.add(100.0 * (at.efficiency - eff(i, j)));
    }
  }
  return s.name + ": flow " + flow.text() + " %, PR " + pressure.text() + " %, efficiency " + efficiency.text() +
         " points, surge PR " + surge.text() + " %";
}

}  // namespace ehm::engine_sim
