// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/figures/compressor_figure.h"

#include <algorithm>
#include <limits>

#include "engine_sim/figures/contour_labels.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
enum Column : std::size_t { speed_percent, r_line_column, flow, pressure_ratio, efficiency };
constexpr PlotColumns plot_columns{flow, pressure_ratio, efficiency};

double scaled_flow_kg_s(const CompressorData& c, double map_flow) {
  return c.scale.s_wc * map_flow * kg_per_lbm;
}

double scaled_pressure_ratio(const CompressorData& c, double map_pressure_ratio) {
  return 1.0 + c.scale.s_pr * (map_pressure_ratio - 1.0);
}

CurvePoint point_at(const CompressorData& c, double speed, double r_line) {
  const CompressorMapPoint<double> at = c.map.at(speed, r_line);
  return {100.0 * speed, r_line, scaled_flow_kg_s(c, at.flow), scaled_pressure_ratio(c, at.pressure_ratio),
          c.scale.s_eff * at.efficiency};
}

Curve speed_line(const CompressorView& view, const CompressorData& c, const std::string& kind, double speed) {
  constexpr int steps = 80;
  Curve line{kind, percent_text(100.0 * speed), {}};
  for (int i = 0; i <= steps; ++i)
    line.points.push_back(point_at(c, speed, 1.0 + (view.highest_r_line - 1.0) * i / steps));
  return line;
}

/// Between the lowest and the highest speed line, fine enough for smooth contours.
std::vector<Curve> efficiency_grid(const CompressorView& view, const CompressorData& c) {
  constexpr int steps = 120;
  const double lowest = view.speeds.front(), highest = view.speeds.back();
  std::vector<Curve> grid;
  for (int i = 0; i <= steps; ++i)
    grid.push_back(speed_line(view, c, "efficiency_grid", lowest + (highest - lowest) * i / steps));
  return grid;
}

/// The line that stall margins refer to, over the flows between the lowest and the highest speed.
Curve surge_line(const CompressorView& view, const CompressorData& c) {
  constexpr int steps = 100;
  const double lowest = c.map.at(view.speeds.front(), 1.0).flow, highest = c.map.at(view.speeds.back(), 1.0).flow;
  Curve line{"surge_line", "surge", {}};
  for (int i = 0; i <= steps; ++i) {
    const double map_flow = lowest + (highest - lowest) * i / steps;
    line.points.push_back({none, none, scaled_flow_kg_s(c, map_flow),
                           scaled_pressure_ratio(c, c.map.surge_pressure_ratio(map_flow)), none});
  }
  return line;
}

Curve reference_curve(const CompressorData& c, const std::vector<ReferencePoint>& reference) {
  Curve curve{"reference", "reference", {}};
  for (const ReferencePoint& p : reference)
    curve.points.push_back({100.0 * p.speed, none, scaled_flow_kg_s(c, p.flow),
                            scaled_pressure_ratio(c, p.pressure_ratio), c.scale.s_eff * p.efficiency});
  return curve;
}

std::vector<Curve> all_curves(const CompressorView& view, const CompressorData& c,
                              const std::vector<OperatingLine>& operating, const CompressorReader& place_of,
                              const std::vector<ReferencePoint>& reference) {
  std::vector<Curve> curves = efficiency_grid(view, c);
  for (const double speed : view.speeds) curves.push_back(speed_line(view, c, "speed_line", speed));
  curves.push_back(surge_line(view, c));
  for (const OperatingLine& line : operating) {
    Curve curve{"operating_line", line.label, {}};
    for (const SteadyPoint& point : line.points) {
      const CompressorPlace at = place_of(point);
      curve.points.push_back(point_at(c, at.speed, at.r_line));
    }
    curves.push_back(std::move(curve));
  }
  if (!reference.empty()) curves.push_back(reference_curve(c, reference));
  return curves;
}

/// Left of each speed line's surge end.
std::string speed_labels(const std::vector<const Curve*>& lines) {
  std::string text;
  for (const Curve* line : lines) {
    const CurvePoint& end = line->points.front();
    text += "set label '" + line->label + " %' at " + decimals(end[flow], 6) + "," + decimals(end[pressure_ratio], 6) +
            " right offset -1.0,0.5 front font ',12' textcolor rgb '#303840'\n";
  }
  return text;
}

std::string script_of(const CompressorView& view, const std::vector<Curve>& curves) {
  const auto grid = curves_of(curves, "efficiency_grid"), speeds = curves_of(curves, "speed_line"),
             surge = curves_of(curves, "surge_line"), operating = curves_of(curves, "operating_line");
  // room for the labels of the speeds at the left
  const AxisRange x = range_of(curves, flow, 0.1, 0.06);
  AxisRange y = range_of(curves, pressure_ratio, 0.06, 0.06);
  y.lowest = std::max(1.0, y.lowest);
  const std::vector<double> levels = efficiency_levels(grid, efficiency);
  std::vector<const Curve*> avoid = speeds;
  avoid.insert(avoid.end(), operating.begin(), operating.end());
  avoid.insert(avoid.end(), surge.begin(), surge.end());

  return common_settings(1000, 760) + data_block("grid", grid) + data_block("speed", speeds) +
         data_block("surge", surge) + overlay_blocks(curves) + contour_settings(levels) +
         "set table $contours\nsplot $grid using 3:4:5\nunset table\n" +
         contour_labels(grid, plot_columns, levels, avoid, x, y) + speed_labels(speeds) + "set title " +
         title_text(view.title) +
         "\nset xlabel 'corrected flow W√θ/δ, kg/s (288.15 K, 101.325 kPa)'\n"
         "set ylabel 'pressure ratio, total to total'\n" +
         range_text("x", x) + range_text("y", y) +
         "set key top left reverse Left box lc rgb '#c8ced3' opaque width 1 height 0.5\n"
         "plot $contours using 1:2 with lines ls 3 title 'efficiency, %', \\\n"
         "  $speed using 3:4 with lines ls 1 title 'corrected speed, % of design', \\\n"
         "  $surge using 3:4 with lines ls 2 title 'surge line'" +
         overlay_plots(curves, flow, pressure_ratio);
}

}  // namespace

Figure compressor_figure(const CompressorView& view, const CompressorData& compressor,
                         const std::vector<OperatingLine>& operating, const CompressorReader& place_of,
                         const std::vector<ReferencePoint>& reference) {
  Figure figure{view.name,
                {"corrected_speed_percent", "r_line", "corrected_flow_kg_s", "pressure_ratio", "efficiency"},
                all_curves(view, compressor, operating, place_of, reference),
                {}};
  figure.script = script_of(view, figure.curves);
  return figure;
}

}  // namespace ehm::engine_sim
