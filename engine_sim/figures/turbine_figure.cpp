// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/figures/turbine_figure.h"

#include <algorithm>
#include <cmath>

#include "engine_sim/figures/contour_labels.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {
namespace {

enum Column : std::size_t { speed_percent, expansion_ratio, flow_parameter, efficiency };
constexpr PlotColumns plot_columns{expansion_ratio, speed_percent, efficiency};

double scaled_flow_parameter(const TurbineData& t, double map_flow) {
  // lbm/s sqrt(R)/psia to kg/s sqrt(K)/kPa
  const double si = kg_per_lbm / std::sqrt(rankine_per_kelvin) / (pa_per_psi / 1000.0);
  return t.scale.s_wc * map_flow * si;
}

double scaled_pressure_ratio(const TurbineData& t, double map_pressure_ratio) {
  return 1.0 + t.scale.s_pr * (map_pressure_ratio - 1.0);
}

CurvePoint point_at(const TurbineData& t, double speed, double map_pressure_ratio) {
  const TurbineMapPoint<double> at = t.map.at(speed, map_pressure_ratio);
  return {speed, scaled_pressure_ratio(t, map_pressure_ratio), scaled_flow_parameter(t, at.flow),
          t.scale.s_eff * at.efficiency};
}

Curve speed_line(const TurbineView& view, const TurbineData& t, const std::string& kind, double speed) {
  constexpr int steps = 80;
  Curve line{kind, percent_text(speed), {}};
  for (int i = 0; i <= steps; ++i)
    line.points.push_back(point_at(
        t, speed, view.lowest_pressure_ratio + (view.highest_pressure_ratio - view.lowest_pressure_ratio) * i / steps));
  return line;
}

std::vector<Curve> all_curves(const TurbineView& view, const TurbineData& t,
                              const std::vector<OperatingLine>& operating, const TurbineReader& place_of,
                              const std::vector<ReferencePoint>& reference) {
  constexpr int grid_steps = 80;
  const double lowest = view.speeds_percent.front(), highest = view.speeds_percent.back();
  std::vector<Curve> curves;
  for (int i = 0; i <= grid_steps; ++i)
    curves.push_back(speed_line(view, t, "efficiency_grid", lowest + (highest - lowest) * i / grid_steps));
  for (const double speed : view.speeds_percent) curves.push_back(speed_line(view, t, "speed_line", speed));
  for (const OperatingLine& line : operating) {
    Curve curve{"operating_line", line.label, {}};
    for (const SteadyPoint& point : line.points) {
      const TurbinePlace at = place_of(point);
      curve.points.push_back(point_at(t, at.speed_percent, 1.0 + (at.pressure_ratio - 1.0) / t.scale.s_pr));
    }
    curves.push_back(std::move(curve));
  }
  if (reference.empty()) return curves;
  Curve points{"reference", "reference", {}};
  for (const ReferencePoint& p : reference)
    points.points.push_back({p.speed, scaled_pressure_ratio(t, p.pressure_ratio), scaled_flow_parameter(t, p.flow),
                             t.scale.s_eff * p.efficiency});
  curves.push_back(std::move(points));
  return curves;
}

/// Each speed line in its own shade, since choked lines lie close together; named beside the panel.
std::string flow_panel(const std::vector<Curve>& curves) {
  const auto speeds = curves_of(curves, "speed_line");
  constexpr const char* shades[] = {"#b9c0c6", "#98a2aa", "#78848d", "#5a6670", "#3f4a53", "#262f37", "#0f161c"};
  std::string text = "plot ";
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    text += std::string(i == 0 ? "" : ", \\\n  ") + "$speed" + std::to_string(i) +
            " using 2:3 with lines lw 2 lc rgb '" + shades[std::min<std::size_t>(i, 6)] + "' title 'speed " +
            speeds[i]->label + " %'";
  }
  return text + overlay_plots(curves, expansion_ratio, flow_parameter);
}

std::string data_blocks(const std::vector<Curve>& curves) {
  std::string text = data_block("grid", curves_of(curves, "efficiency_grid")) + overlay_blocks(curves);
  int line = 0;
  for (const Curve* curve : curves_of(curves, "speed_line"))
    text += data_block("speed" + std::to_string(line++), {curve});
  return text;
}

std::string script_of(const TurbineView& view, const std::vector<Curve>& curves) {
  constexpr double margin = 0.05;
  const auto grid = curves_of(curves, "efficiency_grid"), operating = curves_of(curves, "operating_line");
  const AxisRange x = range_of(curves, expansion_ratio, margin, margin),
                  y = range_of(curves, speed_percent, margin, margin);
  const std::vector<double> levels = efficiency_levels(grid, efficiency);
  return common_settings(1100, 980) + data_blocks(curves) + contour_settings(levels) +
         "set table $contours\nsplot $grid using 2:1:4\nunset table\nset multiplot layout 2,1 title " +
         title_text(view.title) +
         " margins 0.1,0.66,0.085,0.9 spacing 0.12\n"
         "set key outside right center reverse Left samplen 2.5 spacing 1.25 maxcols 1\n"
         "set xlabel 'expansion ratio, total to total'\n" +
         range_text("x", x) + range_text("y", range_of(curves, flow_parameter, margin, margin)) +
         "set ylabel 'flow parameter W√T/P, kg/s √K/kPa'\nset format y '%.2f'\n" + flow_panel(curves) +
         range_text("y", y) + "set ylabel 'speed N/√T, % of design'\nset format y '%g'\n" +
         contour_labels(grid, plot_columns, levels, operating, x, y) +
         "plot $contours using 1:2 with lines ls 3 title 'efficiency, %'" +
         overlay_plots(curves, expansion_ratio, speed_percent) + "unset multiplot\n";
}

}  // namespace

Figure turbine_figure(const TurbineView& view, const TurbineData& turbine, const std::vector<OperatingLine>& operating,
                      const TurbineReader& place_of, const std::vector<ReferencePoint>& reference) {
  Figure figure{view.name,
                {"speed_percent", "expansion_ratio", "flow_parameter_kg_s_sqrtk_per_kpa", "efficiency"},
                all_curves(view, turbine, operating, place_of, reference),
                {}};
  figure.script = script_of(view, figure.curves);
  return figure;
}

}  // namespace ehm::engine_sim
