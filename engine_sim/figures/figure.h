// SPDX-License-Identifier: Apache-2.0
#pragma once
// One picture of a component map: the curves that it shows, as numbers, and the gnuplot script that draws them.
// Its CSV has the columns kind, label and those of the figure; a number that a curve does not have is an empty cell.
// Errors: none.

#include <cstddef>
#include <string>
#include <vector>

namespace ehm::engine_sim {

using CurvePoint = std::vector<double>;  ///< one number a column of the figure; NaN: none

struct Curve {
  std::string kind;   ///< speed_line, surge_line, efficiency_grid, operating_line, reference
  std::string label;  ///< which of them: a speed in percent, a flight condition
  std::vector<CurvePoint> points;
};

struct Figure {
  std::string name;  ///< of its files
  std::vector<std::string> columns;
  std::vector<Curve> curves;
  std::string script;
};

struct AxisRange {
  double lowest, highest;
  double span() const { return highest - lowest; }
};

std::string figure_csv(const Figure& figure);

std::vector<const Curve*> curves_of(const std::vector<Curve>& curves, const std::string& kind);

/// The named data block of a gnuplot script: the curves one after another, separated by a blank line each.
std::string data_block(const std::string& name, const std::vector<const Curve*>& curves);

/// Smallest and largest number of one column; `below` and `above` widen it by shares of the span.
AxisRange range_of(const std::vector<Curve>& curves, std::size_t column, double below, double above);

/// gnuplot's `set xrange` and the like.
std::string range_text(const std::string& axis, const AxisRange& range);

/// The data blocks of operating lines and reference points, and the end of a plot command that draws them on top, with
/// the columns x and y of the figure as axes.
std::string overlay_blocks(const std::vector<Curve>& curves);
std::string overlay_plots(const std::vector<Curve>& curves, std::size_t x, std::size_t y);

/// Settings that all pictures share: SVG on white, fonts, line styles 1 speed lines, 2 surge line, 3 contours,
/// 4 and 5 the operating lines, 6 reference points.
std::string common_settings(int width, int height);

/// `number` with a fixed count of decimals, for labels and axes.
std::string decimals(double number, int count);

/// A percentage as short as it goes: 100, 97.5.
std::string percent_text(double percent);

/// The title of a picture, with a second line that tells how to read it.
std::string title_text(const std::string& title);

}  // namespace ehm::engine_sim
