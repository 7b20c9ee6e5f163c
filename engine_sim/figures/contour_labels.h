// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where the labels of contours go: for each level, of all places where it crosses a line of the grid, the one that is
// farthest from the other labels and from what is drawn already. Distances are relative to the axes' spans and to the
// width and height of a label. Greedy, so the same input gives the same picture. Errors: none.

#include <span>
#include <string>
#include <vector>

#include "engine_sim/figures/figure.h"

namespace ehm::engine_sim {

/// Columns of the figure that a contour plot takes: the coordinates of the picture, and what the contours are of.
struct PlotColumns {
  std::size_t x, y, z;
};

/// `avoid`: curves in the same columns. @return gnuplot's `set label` lines, text in percent of z
std::string contour_labels(const std::vector<const Curve*>& grid, const PlotColumns& columns,
                           std::span<const double> levels, const std::vector<const Curve*>& avoid, const AxisRange& x,
                           const AxisRange& y);

/// The levels of efficiency that are drawn: all below the highest in the grid.
std::vector<double> efficiency_levels(const std::vector<const Curve*>& grid, std::size_t column);

/// gnuplot's `set cntrparam` for these levels.
std::string contour_settings(std::span<const double> levels);

}  // namespace ehm::engine_sim
