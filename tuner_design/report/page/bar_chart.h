// SPDX-License-Identifier: Apache-2.0
#pragma once
// Horizontal bars in groups: one group a category, one bar a series, and marks across the group for what the bars are
// compared with. A logarithmic axis begins at a power of ten below the smallest value; what is not positive has no bar
// there, only its number. On a narrow drawing the names stand above their groups. Errors: none.

#include <string>
#include <vector>

#include "tuner_design/report/page/chart_frame.h"

namespace ehm::tuner_design::report {

struct BarSeries {
  std::string name;
  std::vector<double> values;  ///< one a category; not finite: no bar
  int colour = 1;
  double thickness_px = 14.0;
  bool numbered = true;  ///< the value stands behind the bar
};

struct BarMark {
  std::string name;
  std::vector<double> values;  ///< one a category
  Mark mark = Mark::tick;      ///< tick or diamond
  int colour = 6;
};

struct BarChart {
  std::string id, title, description;  ///< `id`: letters, digits and hyphens, unique on the page
  std::vector<std::string> categories;
  std::vector<BarSeries> series;
  std::vector<BarMark> marks;
  std::string axis_title;  ///< with unit
  bool logarithmic = false;
  std::string heading{};  ///< stands in the drawing, above the bars: panels need one
};

std::vector<LegendEntry> legend_of(const BarChart& chart);

/// SVG `width` px wide; names stand beside the bars from 500 px on.
std::string draw(const BarChart& chart, double width, const std::string& id);

}  // namespace ehm::tuner_design::report
