// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/figures/figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "deploy/runtime/files/csv_table.h"

namespace ehm::engine_sim {

std::string figure_csv(const Figure& figure) {
  std::string text = "kind,label";
  for (const std::string& column : figure.columns) text += ',' + column;
  text += '\n';
  for (const Curve& curve : figure.curves) {
    for (const CurvePoint& point : curve.points) {
      text += curve.kind + ',' + curve.label;
      for (const double number : point) text += ',' + (std::isnan(number) ? std::string() : files::shortest(number));
      text += '\n';
    }
  }
  return text;
}

std::vector<const Curve*> curves_of(const std::vector<Curve>& curves, const std::string& kind) {
  std::vector<const Curve*> out;
  for (const Curve& curve : curves) {
    if (curve.kind == kind) out.push_back(&curve);
  }
  return out;
}

std::string data_block(const std::string& name, const std::vector<const Curve*>& curves) {
  std::string text = "$" + name + " << EOD\n";
  for (const Curve* curve : curves) {
    for (const CurvePoint& point : curve->points) {
      for (const double number : point) text += files::shortest(number) + ' ';
      text += '\n';
    }
    text += '\n';
  }
  return text + "EOD\n";
}

AxisRange range_of(const std::vector<Curve>& curves, std::size_t column, double below, double above) {
  AxisRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Curve& curve : curves) {
    for (const CurvePoint& point : curve.points) {
      if (std::isnan(point[column])) continue;
      range.lowest = std::min(range.lowest, point[column]);
      range.highest = std::max(range.highest, point[column]);
    }
  }
  return {range.lowest - below * range.span(), range.highest + above * range.span()};
}

std::string range_text(const std::string& axis, const AxisRange& range) {
  return "set " + axis + "range [" + decimals(range.lowest, 4) + ":" + decimals(range.highest, 4) + "]\n";
}

std::string overlay_blocks(const std::vector<Curve>& curves) {
  std::string text = data_block("reference", curves_of(curves, "reference"));
  int line = 0;
  for (const Curve* curve : curves_of(curves, "operating_line"))
    text += data_block("operating" + std::to_string(line++), {curve});
  return text;
}

std::string overlay_plots(const std::vector<Curve>& curves, std::size_t x, std::size_t y) {
  // gnuplot counts columns from 1
  const std::string columns = " using " + std::to_string(x + 1) + ":" + std::to_string(y + 1);
  std::string text;
  int line = 0;
  for (const Curve* curve : curves_of(curves, "operating_line")) {
    text += ", \\\n  $operating" + std::to_string(line) + columns + " with lines ls " + std::to_string(4 + line) +
            " title 'operating line, " + curve->label + "'";
    ++line;
  }
  if (!curves_of(curves, "reference").empty())
    text += ", \\\n  $reference" + columns + " with points ls 6 title 'reference points'";
  return text + "\n";
}

std::string common_settings(int width, int height) {
  return "set terminal svg size " + std::to_string(width) + "," + std::to_string(height) +
         " dynamic background rgb 'white' font 'Helvetica,14'\n"
         "set encoding utf8\n"
         "set border 3 lc rgb '#404a52' lw 1.2\n"
         "set tics nomirror out textcolor rgb '#202020'\n"
         "set grid lc rgb '#e6eaed' lw 1 lt 1\n"
         "set style line 1 lc rgb '#505a62' lw 1.6\n"
         "set style line 2 lc rgb '#c1121f' lw 3.2\n"
         "set style line 3 lc rgb '#3a8f5c' lw 1.1\n"
         "set style line 4 lc rgb '#1f5fb2' lw 2.4\n"
         "set style line 5 lc rgb '#d97706' lw 2.4 dt (12,5)\n"
         "set style line 6 lc rgb '#7b2d8b' pt 6 ps 0.4 lw 0.8\n"
         "set style textbox opaque noborder fillcolor rgb 'white' margins 0.4,0.2\n"
         "set contour base\nunset surface\nset cntrparam linear\n";
}

std::string decimals(double number, int count) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", count, number);
  return text;
}

std::string percent_text(double percent) {
  return decimals(percent, std::abs(percent - std::round(percent)) < 1e-6 ? 0 : 1);
}

std::string title_text(const std::string& title) {
  return "\"{/=18 " + title +
         "}\\n{/=12 speed lines and contours lie within the tables of the map; operating lines run from maximum power "
         "to idle}\"";
}

}  // namespace ehm::engine_sim
