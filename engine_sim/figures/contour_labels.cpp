// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/figures/contour_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace ehm::engine_sim {
namespace {

/// In units of a label's width and height, so that distance 1 is where two labels touch.
struct Place {
  double x, y;
};

constexpr double labels_across = 20.0, labels_high = 30.0;  ///< of a picture's axes
constexpr double label_weight = 0.3;                        ///< labels keep three times the distance of curves

Place place_of(const CurvePoint& point, const PlotColumns& c, const AxisRange& x, const AxisRange& y) {
  return {labels_across * (point[c.x] - x.lowest) / x.span(), labels_high * (point[c.y] - y.lowest) / y.span()};
}

double nearest(const Place& from, const std::vector<Place>& others) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Place& other : others) distance = std::min(distance, std::hypot(from.x - other.x, from.y - other.y));
  return distance;
}

/// Where the level is crossed between two neighbours of a grid line.
std::optional<CurvePoint> crossing(const CurvePoint& a, const CurvePoint& b, std::size_t z, double level) {
  if ((a[z] - level) * (b[z] - level) > 0.0 || a[z] == b[z]) return std::nullopt;
  const double share = (level - a[z]) / (b[z] - a[z]);
  CurvePoint point = a;
  for (std::size_t i = 0; i < point.size(); ++i) point[i] += share * (b[i] - a[i]);
  return point;
}

std::vector<CurvePoint> crossings(const std::vector<const Curve*>& grid, std::size_t z, double level) {
  std::vector<CurvePoint> found;
  for (const Curve* line : grid) {
    for (std::size_t i = 1; i < line->points.size(); ++i) {
      if (auto point = crossing(line->points[i - 1], line->points[i], z, level)) found.push_back(std::move(*point));
    }
  }
  return found;
}

bool inside(const Place& place) {
  constexpr double margin = 1.0;
  return place.x > margin && place.x < labels_across - margin && place.y > margin && place.y < labels_high - margin;
}

std::string label_text(const CurvePoint& at, const PlotColumns& c, double level) {
  return "set label '" + decimals(100.0 * level, 0) + " %' at " + decimals(at[c.x], 6) + "," + decimals(at[c.y], 6) +
         " center front boxed font ',11' textcolor rgb '#246b42'\n";
}

}  // namespace

std::string contour_labels(const std::vector<const Curve*>& grid, const PlotColumns& columns,
                           std::span<const double> levels, const std::vector<const Curve*>& avoid, const AxisRange& x,
                           const AxisRange& y) {
  std::vector<Place> drawn, labels;
  for (const Curve* curve : avoid) {
    for (const CurvePoint& point : curve->points) drawn.push_back(place_of(point, columns, x, y));
  }
  std::string text;
  for (const double level : levels) {
    std::optional<CurvePoint> best;
    double best_distance = 0.7;  // closer than this, a level rather goes without a label
    for (const CurvePoint& candidate : crossings(grid, columns.z, level)) {
      const Place place = place_of(candidate, columns, x, y);
      if (!inside(place)) continue;
      const double distance = std::min(nearest(place, drawn), label_weight * nearest(place, labels));
      if (distance <= best_distance) continue;
      best = candidate;
      best_distance = distance;
    }
    if (!best) continue;
    labels.push_back(place_of(*best, columns, x, y));
    text += label_text(*best, columns, level);
  }
  return text;
}

std::vector<double> efficiency_levels(const std::vector<const Curve*>& grid, std::size_t column) {
  // by one point near the highest, then by two, five and ten
  constexpr std::array levels{0.96, 0.95, 0.94, 0.93, 0.92, 0.91, 0.90, 0.89, 0.88, 0.87,
                              0.86, 0.85, 0.84, 0.82, 0.80, 0.75, 0.70, 0.60, 0.50};
  constexpr std::size_t fine_levels = 3;
  double highest = 0.0;
  for (const Curve* line : grid) {
    for (const CurvePoint& point : line->points) highest = std::max(highest, point[column]);
  }
  std::vector<double> chosen;
  for (const double level : levels) {
    const bool even = std::lround(100.0 * level) % 2 == 0 || level <= 0.75;
    if (level < highest && (chosen.size() < fine_levels || even)) chosen.push_back(level);
  }
  return chosen;
}

std::string contour_settings(std::span<const double> levels) {
  std::string text = "set cntrparam levels discrete ";
  for (const double level : levels) text += (level == levels.front() ? "" : ",") + decimals(level, 4);
  return text + '\n';
}

}  // namespace ehm::engine_sim
