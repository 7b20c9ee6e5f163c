// SPDX-License-Identifier: Apache-2.0
#pragma once
// Lines and points over two axes, each linear or logarithmic. What an axis cannot show (not finite; not positive on a
// logarithmic one) is left out, and the line is interrupted there. The y title stands above the plot. Errors: none.

#include <string>
#include <vector>

#include "tuner_design/report/page/chart_frame.h"
#include "tuner_design/report/page/data_table.h"

namespace ehm::tuner_design::report {

struct LineSeries {
  std::string name;
  std::vector<double> x, y;  ///< equally long
  int colour = 1;
  Mark mark = Mark::line;  ///< line, dashed_line or circle (points without a line)
  bool thin = false;       ///< context; left out of the legend unless it is the first of its colour
};

struct ChartAxis {
  std::string title;  ///< with unit
  bool logarithmic = false;
  bool with_zero = false;
  std::vector<double>
      holds{};  ///< values that the axis shows beside those of the series, as where panels share a scale
};

struct LineChart {
  std::string id, title, description;  ///< `id`: letters, digits and hyphens, unique on the page
  ChartAxis x, y;
  std::vector<LineSeries> series;  ///< drawn in this order
  double height_px = 300.0;
  std::string heading{};  ///< stands in the drawing, above the y title: panels need one
};

std::vector<LegendEntry> legend_of(const LineChart& chart);

std::string draw(const LineChart& chart, double width, const std::string& id);

/// A row for each point: series, x, y under the axes' titles.
DataTable data_of(const LineChart& chart);

}  // namespace ehm::tuner_design::report
