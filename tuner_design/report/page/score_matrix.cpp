// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/score_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/report/page/axis.h"
#include "tuner_design/report/page/svg.h"
#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {
namespace {

constexpr double cell_height = 26.0, most_cell = 62.0, most_label = 150.0, number_room = 46.0;
constexpr double bars_wide = 190.0, bars_gap = 14.0, bar_height = 13.0, axis_foot = 40.0;
constexpr double legend_foot = 62.0, narrow_legend_foot = 118.0;
constexpr double corner = 9.0, least_wide = 500.0, least_numbered = 30.0;
constexpr std::size_t name_lines = 2;
constexpr double steep = -60.0;  ///< degrees of the columns' names on a narrow drawing

struct Layout {
  bool wide, bars_beside;
  double left, top, cell, bottom;

  double row(std::size_t i) const { return top + static_cast<double>(i) * cell_height; }
};

Layout layout_of(const ScoreMatrix& matrix, double width) {
  const bool wide = width >= least_wide;
  Layout layout{wide, !matrix.bars.empty() && wide, 40.0, 8.0 + name_lines * line_px, 0.0, 0.0};
  for (const std::string& name : matrix.rows)
    layout.left = std::max(layout.left, std::min(most_label, letters(name) * letter_px + 14.0));
  double room = width - layout.left - 2.0 - (layout.bars_beside ? bars_wide + bars_gap : 0.0);
  if (!wide) {
    int longest = 1;
    for (const std::string& name : matrix.columns) longest = std::max(longest, letters(name));
    layout.top = 14.0 + longest * tick_letter_px * std::sin(-steep * M_PI / 180.0);
    // the last name leans out to the right
    room -= std::max(0.0, longest * tick_letter_px * std::cos(steep * M_PI / 180.0) - 10.0);
  }
  layout.cell = std::min(most_cell, room / std::max<double>(1.0, static_cast<double>(matrix.columns.size())));
  layout.bottom = layout.row(matrix.rows.size());
  return layout;
}

/// -1 at 1 over the full scale, 0 at 1, 1 at the full scale.
double strength(double value, double full_scale) {
  return std::isfinite(value) && value > 0.0 ? std::clamp(std::log(value) / std::log(full_scale), -1.0, 1.0) : 0.0;
}

void colour(Svg& svg, double x, double y, double width, double height, double strong) {
  svg.rect(x, y, width, height, strong > 0.0 ? "cell negative" : "cell positive",
           fmt::format("fill-opacity=\"{:.2f}\"", std::abs(strong)));
}

void cut_corner(Svg& svg, double right, double top) {
  svg.polygon({{right - corner, top}, {right, top}, {right, top + corner}}, "defect");
}

void draw_cell(Svg& svg, const ScoreMatrix& matrix, const Layout& layout, std::size_t i, std::size_t j) {
  const double value = matrix.values(as_index(i), as_index(j));
  const bool marked = matrix.marked.size() > 0 && matrix.marked(as_index(i), as_index(j)) != 0;
  const double x = layout.left + static_cast<double>(j) * layout.cell, y = layout.row(i);
  svg.open(matrix.rows[i] + ", " + matrix.columns[j] + ": " + number(value, 4) +
           (marked ? ", " + matrix.mark_title : ""));
  const double strong = strength(value, matrix.full_scale);
  colour(svg, x, y, layout.cell, cell_height, strong);
  if (layout.cell >= least_numbered)
    svg.text(x + layout.cell / 2.0, y + cell_height / 2.0 + 4.0, number(value, 2),
             std::abs(strong) > 0.75 ? "cell-number strong" : "cell-number", Anchor::middle);
  if (marked) cut_corner(svg, x + layout.cell, y);
  svg.close();
}

void draw_column_name(Svg& svg, const std::string& name, const Layout& layout, double middle) {
  if (!layout.wide) return svg.turned_text(middle + 4.0, layout.top - 6.0, steep, name, "tick", Anchor::start);
  const auto lines = broken(name, static_cast<int>(layout.cell / tick_letter_px), name_lines);
  double y = layout.top - 7.0 - static_cast<double>(lines.size() - 1) * line_px;
  for (const std::string& line : lines) {
    svg.text(middle, y, line, "tick", Anchor::middle);
    y += line_px;
  }
}

void draw_row_names(Svg& svg, const ScoreMatrix& matrix, const Layout& layout) {
  for (std::size_t i = 0; i < matrix.rows.size(); ++i)
    svg.text(layout.left - 6.0, layout.row(i) + cell_height / 2.0 + 4.0,
             shortened(matrix.rows[i], static_cast<int>((layout.left - 8.0) / letter_px)), "label", Anchor::end);
}

/// Bars in the rows' order from `top` on, the axis below.
void draw_bars(Svg& svg, const ScoreMatrix& matrix, double left, double width, double top) {
  const Axis axis = Axis::logarithmic(matrix.bars, 4);
  const double room = width - number_room, bottom = top + static_cast<double>(matrix.rows.size()) * cell_height;
  const auto x = [&](double value) { return left + room * axis.fraction(value); };
  for (const Tick& tick : axis.ticks()) {
    svg.line(x(tick.value), top, x(tick.value), bottom, tick.label.empty() ? "grid minor" : "grid");
    if (!tick.label.empty()) svg.text(x(tick.value), bottom + 14.0, tick.label, "tick", Anchor::middle);
  }
  for (std::size_t i = 0; i < matrix.rows.size(); ++i) {
    const double value = matrix.bars[i], middle = top + (static_cast<double>(i) + 0.5) * cell_height;
    if (!axis.shows(value)) continue;
    svg.open(matrix.rows[i] + ": " + number(value, 4));
    svg.rect(left, middle - bar_height / 2.0, x(value) - left, bar_height, "fill6");
    svg.text(x(value) + 6.0, middle + 4.0, number(value, 2), "value");
    svg.close();
  }
  svg.line(left, top, left, bottom, "frame");
  svg.text(left + room / 2.0, bottom + 32.0, matrix.bar_title, "axis", Anchor::middle);
}

/// Down from `y`; where the text ended.
double draw_words(Svg& svg, const std::string& text, double x, double y, double width) {
  for (const std::string& line : broken(text, static_cast<int>((width - x) / letter_px), name_lines)) {
    svg.text(x, y, line, "axis");
    y += line_px;
  }
  return y;
}

/// On a wide drawing the words stand beside the scale, on a narrow one below.
void draw_legend(Svg& svg, const ScoreMatrix& matrix, const Layout& layout, double top, double width) {
  constexpr int middle = 5, steps = 2 * middle + 1;
  constexpr double step_px = 14.0, height = 12.0, left = 26.0, end = left + steps * step_px;
  for (int i = 0; i < steps; ++i)
    colour(svg, left + i * step_px, top, step_px, height, (i - middle) / static_cast<double>(middle));
  const double below = top + height + 13.0;
  svg.text(left, below, number(1.0 / matrix.full_scale, 1), "tick", Anchor::middle);
  svg.text((left + end) / 2.0, below, "1", "tick", Anchor::middle);
  svg.text(end, below, fmt::format("{:g}", matrix.full_scale), "tick", Anchor::middle);
  const double x = layout.wide ? end + 30.0 : 4.0;
  const double next = draw_words(svg, matrix.scale_title, x, layout.wide ? top + 10.0 : below + 20.0, width);
  if (matrix.mark_title.empty()) return;
  svg.rect(x, next - 4.0, 20.0, 14.0, "cell positive", "fill-opacity=\"0\"");
  cut_corner(svg, x + 20.0, next - 4.0);
  draw_words(svg, matrix.mark_title, x + 28.0, next + 7.0, width);
}

}  // namespace

std::vector<LegendEntry> legend_of(const ScoreMatrix&) {
  return {};
}

std::string draw(const ScoreMatrix& matrix, double width, const std::string& id) {
  const Layout layout = layout_of(matrix, width);
  const bool bars_below = !matrix.bars.empty() && !layout.bars_beside;
  const double bars_height = static_cast<double>(matrix.rows.size()) * cell_height + axis_foot;
  const double foot = layout.bottom + (layout.bars_beside ? axis_foot : 0.0) + 14.0;
  const double under = foot + (layout.wide ? legend_foot : narrow_legend_foot);
  Svg svg(id, width, under + (bars_below ? bars_height : 0.0), matrix.title, matrix.description);
  for (std::size_t j = 0; j < matrix.columns.size(); ++j)
    draw_column_name(svg, matrix.columns[j], layout, layout.left + (static_cast<double>(j) + 0.5) * layout.cell);
  draw_row_names(svg, matrix, layout);
  for (std::size_t i = 0; i < matrix.rows.size(); ++i)
    for (std::size_t j = 0; j < matrix.columns.size(); ++j) draw_cell(svg, matrix, layout, i, j);
  draw_legend(svg, matrix, layout, foot, width);
  if (layout.bars_beside) {
    const double left = layout.left + layout.cell * static_cast<double>(matrix.columns.size()) + bars_gap;
    draw_bars(svg, matrix, left, width - left - 2.0, layout.top);
  }
  if (bars_below) {
    Layout below = layout;
    below.top = under;
    draw_row_names(svg, matrix, below);
    draw_bars(svg, matrix, layout.left, width - layout.left - 2.0, below.top);
  }
  return svg.markup();
}

}  // namespace ehm::tuner_design::report
