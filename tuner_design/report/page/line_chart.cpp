// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/line_chart.h"

#include <algorithm>
#include <set>

#include "tuner_design/report/page/axis.h"
#include "tuner_design/report/page/svg.h"
#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {
namespace {

constexpr double head = 24.0, foot = 42.0, right = 16.0;

struct Frame {
  Axis x_axis, y_axis;
  double left, top, width, height;

  double x(double value) const { return left + width * x_axis.fraction(value); }
  double y(double value) const { return top + height * (1.0 - y_axis.fraction(value)); }
  double bottom() const { return top + height; }
  bool shows(double at_x, double at_y) const { return x_axis.shows(at_x) && y_axis.shows(at_y); }
};

Axis axis_of(const ChartAxis& settings, const std::vector<LineSeries>& series, std::vector<double> LineSeries::*part,
             int ticks) {
  std::vector<double> values = settings.holds;
  for (const LineSeries& line : series) values.insert(values.end(), (line.*part).begin(), (line.*part).end());
  return settings.logarithmic ? Axis::logarithmic(values, ticks) : Axis::linear(values, settings.with_zero, ticks);
}

Frame frame_of(const LineChart& chart, double width) {
  Frame frame{axis_of(chart.x, chart.series, &LineSeries::x, width < 500.0 ? 4 : 8),
              axis_of(chart.y, chart.series, &LineSeries::y, 5),
              0.0,
              head,
              0.0,
              0.0};
  int longest = 1;
  for (const Tick& tick : frame.y_axis.ticks()) longest = std::max(longest, letters(tick.label));
  frame.left = 12.0 + longest * tick_letter_px;
  frame.top += chart.heading.empty() ? 0.0 : heading_room;
  frame.width = width - frame.left - right;
  frame.height = chart.height_px - frame.top - foot;
  return frame;
}

void draw_axes(Svg& svg, const LineChart& chart, const Frame& frame) {
  for (const Tick& tick : frame.y_axis.ticks()) {
    const double y = frame.y(tick.value);
    svg.line(frame.left, y, frame.left + frame.width, y, tick.label.empty() ? "grid minor" : "grid");
    if (!tick.label.empty()) svg.text(frame.left - 6.0, y + 4.0, tick.label, "tick", Anchor::end);
  }
  for (const Tick& tick : frame.x_axis.ticks()) {
    const double x = frame.x(tick.value);
    svg.line(x, frame.top, x, frame.bottom(), tick.label.empty() ? "grid minor" : "grid");
    if (!tick.label.empty()) svg.text(x, frame.bottom() + 15.0, tick.label, "tick", Anchor::middle);
  }
  svg.line(frame.left, frame.top, frame.left, frame.bottom(), "frame");
  svg.line(frame.left, frame.bottom(), frame.left + frame.width, frame.bottom(), "frame");
  svg.text(2.0, frame.top - 9.0, chart.y.title, "axis");
  svg.text(frame.left + frame.width / 2.0, frame.bottom() + 34.0, chart.x.title, "axis", Anchor::middle);
}

void draw_line(Svg& svg, const LineSeries& line, const Frame& frame) {
  std::string style = "line stroke" + std::to_string(line.colour);
  if (line.mark == Mark::dashed_line) style += " dashed";
  if (line.thin) style += " thin";
  Points part;
  const auto finish = [&] {
    if (part.size() > 1) svg.polyline(part, style);
    part.clear();
  };
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (frame.shows(line.x[i], line.y[i])) {
      part.emplace_back(frame.x(line.x[i]), frame.y(line.y[i]));
    } else {
      finish();
    }
  }
  finish();
}

void draw_points(Svg& svg, const LineSeries& line, const Frame& frame) {
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!frame.shows(line.x[i], line.y[i])) continue;
    svg.open(line.name + ": " + number(line.x[i], 4) + "; " + number(line.y[i], 5));
    svg.circle(frame.x(line.x[i]), frame.y(line.y[i]), line.thin ? 2.5 : 4.0, "fill" + std::to_string(line.colour));
    svg.close();
  }
}

}  // namespace

std::vector<LegendEntry> legend_of(const LineChart& chart) {
  std::vector<LegendEntry> entries;
  std::set<std::string> named;
  for (const LineSeries& line : chart.series) {
    if (named.insert(line.name).second) entries.push_back({line.mark, line.colour, line.name});
  }
  return entries;
}

std::string draw(const LineChart& chart, double width, const std::string& id) {
  const Frame frame = frame_of(chart, width);
  Svg svg(id, width, chart.height_px, chart.title, chart.description);
  if (!chart.heading.empty())
    svg.text(2.0, 14.0, shortened(chart.heading, static_cast<int>(width / heading_letter_px)), "heading");
  draw_axes(svg, chart, frame);
  for (const LineSeries& line : chart.series) {
    if (line.mark == Mark::circle) {
      draw_points(svg, line, frame);
    } else {
      draw_line(svg, line, frame);
    }
  }
  return svg.markup();
}

DataTable data_of(const LineChart& chart) {
  DataTable table{{"series", chart.x.title, chart.y.title}, {}};
  for (const LineSeries& line : chart.series) {
    for (std::size_t i = 0; i < line.x.size(); ++i) table.rows.push_back({line.name, line.x[i], line.y[i]});
  }
  return table;
}

}  // namespace ehm::tuner_design::report
