// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/bar_chart.h"

#include <algorithm>

#include "tuner_design/report/page/axis.h"
#include "tuner_design/report/page/svg.h"
#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {
namespace {

constexpr double number_room = 62.0, group_gap = 12.0, bar_gap = 1.5, foot = 40.0, narrow_left = 12.0;
constexpr double least_wide = 500.0, most_label = 230.0, least_label = 60.0;
constexpr std::size_t label_lines = 3;

struct Layout {
  Axis axis;
  bool labels_beside;
  double left, plot_width, bars_height;
  double head;
  std::vector<std::vector<std::string>> labels;

  double x(double value) const { return left + plot_width * axis.fraction(value); }
  double label_height(std::size_t category) const { return static_cast<double>(labels[category].size()) * line_px; }
  double group_height(std::size_t category) const {
    return labels_beside ? std::max(bars_height, label_height(category)) : bars_height + label_height(category);
  }
};

Axis axis_of(const BarChart& chart, int ticks) {
  std::vector<double> values;
  for (const BarSeries& series : chart.series) values.insert(values.end(), series.values.begin(), series.values.end());
  for (const BarMark& mark : chart.marks) values.insert(values.end(), mark.values.begin(), mark.values.end());
  return chart.logarithmic ? Axis::logarithmic(values, ticks) : Axis::linear(values, true, ticks);
}

Layout layout_of(const BarChart& chart, double width) {
  Layout layout{axis_of(chart, width < least_wide ? 4 : 7), width >= least_wide, narrow_left, 0.0, 0.0, 8.0, {}};
  if (layout.labels_beside) {
    double longest = least_label;
    for (const std::string& name : chart.categories) longest = std::max(longest, letters(name) * letter_px + 12.0);
    layout.left = std::min(longest, most_label);
  }
  const double label_room = layout.labels_beside ? layout.left - 12.0 : width - 12.0;
  for (const std::string& name : chart.categories)
    layout.labels.push_back(broken(name, static_cast<int>(label_room / letter_px), label_lines));
  layout.plot_width = width - layout.left - number_room;
  for (const BarSeries& series : chart.series) layout.bars_height += series.thickness_px + bar_gap;
  return layout;
}

void draw_axis(Svg& svg, const BarChart& chart, const Layout& layout, double bottom) {
  for (const Tick& tick : layout.axis.ticks()) {
    const double x = layout.x(tick.value);
    svg.line(x, layout.head, x, bottom, tick.label.empty() ? "grid minor" : "grid");
    if (!tick.label.empty()) svg.text(x, bottom + 14.0, tick.label, "tick", Anchor::middle);
  }
  svg.text(layout.left + layout.plot_width / 2.0, bottom + 32.0, chart.axis_title, "axis", Anchor::middle);
}

void draw_label(Svg& svg, const Layout& layout, std::size_t category, double top) {
  double y = top + 11.0;
  if (layout.labels_beside) y += (layout.group_height(category) - layout.label_height(category)) / 2.0;
  for (const std::string& line : layout.labels[category]) {
    svg.text(layout.labels_beside ? layout.left - 8.0 : layout.left, y, line, "label",
             layout.labels_beside ? Anchor::end : Anchor::start);
    y += line_px;
  }
}

void draw_mark(Svg& svg, Mark mark, int colour, double x, double top, double bottom) {
  const std::string style = std::to_string(colour);
  if (mark == Mark::diamond) {
    const double y = top + 7.0;
    svg.polygon({{x, y - 5.0}, {x + 5.0, y}, {x, y + 5.0}, {x - 5.0, y}}, "hollow" + style);
  } else {
    svg.line(x, top - 2.0, x, bottom + 1.0, "stroke" + style);
  }
}

/// Right of the bar's end, and of the marks that would cross the number there.
double free_place(double end, const std::string& text, const std::vector<double>& marks) {
  constexpr double gap = 8.0;
  double place = end + gap;
  for (const double mark : marks) {
    if (mark > place - gap && mark < place + letters(text) * tick_letter_px + gap) place = mark + gap;
  }
  return place;
}

void draw_group(Svg& svg, const BarChart& chart, const Layout& layout, std::size_t category, double top) {
  draw_label(svg, layout, category, top);
  const double first = layout.labels_beside ? top + (layout.group_height(category) - layout.bars_height) / 2.0
                                            : top + layout.label_height(category);
  double y = first;
  for (const BarSeries& series : chart.series) {
    const double value = series.values[category];
    if (layout.axis.shows(value)) {
      svg.open(chart.categories[category] + ", " + series.name + ": " + number(value, 5));
      svg.rect(layout.left, y, layout.x(value) - layout.left, series.thickness_px,
               "fill" + std::to_string(series.colour));
      svg.close();
    }
    y += series.thickness_px + bar_gap;
  }
  std::vector<double> marks;
  for (const BarMark& mark : chart.marks) {
    const double value = mark.values[category];
    if (!layout.axis.shows(value)) continue;
    svg.open(chart.categories[category] + ", " + mark.name + ": " + number(value, 5));
    draw_mark(svg, mark.mark, mark.colour, layout.x(value), first, first + layout.bars_height);
    svg.close();
    marks.push_back(layout.x(value));
  }
  std::sort(marks.begin(), marks.end());
  y = first;
  for (const BarSeries& series : chart.series) {
    const double value = series.values[category];
    if (series.numbered)
      svg.text(free_place(layout.x(value), number(value), marks), y + series.thickness_px / 2.0 + 4.0, number(value),
               "value");
    y += series.thickness_px + bar_gap;
  }
}

}  // namespace

std::vector<LegendEntry> legend_of(const BarChart& chart) {
  std::vector<LegendEntry> entries;
  for (const BarSeries& series : chart.series) entries.push_back({Mark::bar, series.colour, series.name});
  for (const BarMark& mark : chart.marks) entries.push_back({mark.mark, mark.colour, mark.name});
  return entries;
}

std::string draw(const BarChart& chart, double width, const std::string& id) {
  Layout layout = layout_of(chart, width);
  if (!chart.heading.empty()) layout.head += heading_room;
  double bottom = layout.head;
  for (std::size_t i = 0; i < chart.categories.size(); ++i) bottom += layout.group_height(i) + group_gap;
  Svg svg(id, width, bottom + foot, chart.title, chart.description);
  svg.text(2.0, 14.0, shortened(chart.heading, static_cast<int>(width / heading_letter_px)), "heading");
  draw_axis(svg, chart, layout, bottom);
  double top = layout.head + group_gap / 2.0;
  for (std::size_t i = 0; i < chart.categories.size(); ++i) {
    draw_group(svg, chart, layout, i, top);
    top += layout.group_height(i) + group_gap;
  }
  svg.line(layout.left, layout.head, layout.left, bottom, "frame");
  return svg.markup();
}

}  // namespace ehm::tuner_design::report
