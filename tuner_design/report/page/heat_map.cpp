// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/report/page/svg.h"
#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {
namespace {

constexpr double cell_height = 26.0, most_cell = 64.0, number_room = 33.0, scale_foot = 54.0;
constexpr double most_label = 190.0, most_narrow_label = 112.0;
constexpr int most_column_letters = 22;
constexpr double steep = -60.0;  ///< degrees of the column names

struct Layout {
  double left, top, cell, full_scale;
};

Layout layout_of(const HeatMap& map, double width) {
  double label = 40.0;
  for (const std::string& name : map.rows) label = std::max(label, letters(name) * letter_px + 14.0);
  int highest = 1;
  for (const std::string& name : map.columns) highest = std::max(highest, std::min(letters(name), most_column_letters));
  Layout layout{};
  layout.left = std::min(label, width < 500.0 ? most_narrow_label : most_label);
  layout.top = 20.0 + highest * tick_letter_px * std::sin(-steep * M_PI / 180.0);
  // the last column's name leans out to the right
  const double lean = highest * tick_letter_px * std::cos(steep * M_PI / 180.0);
  const double columns = std::max<double>(1.0, static_cast<double>(map.columns.size()));
  layout.cell = std::min(most_cell, (width - layout.left - 4.0) / columns);
  const double overhang = lean - layout.cell / 2.0 + 4.0;
  if (layout.left + columns * layout.cell + overhang > width)
    layout.cell = std::min(layout.cell, (width - layout.left - lean - 4.0) / (columns - 0.5));
  layout.full_scale = map.full_scale > 0.0    ? map.full_scale
                      : map.values.size() > 0 ? map.values.cwiseAbs().maxCoeff()
                                              : 0.0;
  if (!(layout.full_scale > 0.0)) layout.full_scale = 1.0;
  return layout;
}

double strength(double value, double full_scale) {
  return std::isfinite(value) ? std::min(1.0, std::abs(value) / full_scale) : 0.0;
}

void draw_cell(Svg& svg, const HeatMap& map, const Layout& layout, Eigen::Index i, Eigen::Index j) {
  const double value = map.values(i, j);
  const double x = layout.left + static_cast<double>(j) * layout.cell;
  const double y = layout.top + static_cast<double>(i) * cell_height;
  const double strong = strength(value, layout.full_scale);
  svg.open(map.rows[as_size(i)] + ", " + map.columns[as_size(j)] + ": " + number(value, 4));
  svg.rect(x, y, layout.cell, cell_height, value < 0.0 ? "cell negative" : "cell positive",
           fmt::format("fill-opacity=\"{:.2f}\"", strong));
  if (layout.cell >= number_room) {
    const std::string text = std::abs(value) < 0.005 * layout.full_scale ? "0" : fmt::format("{:.2f}", value);
    svg.text(x + layout.cell / 2.0, y + cell_height / 2.0 + 4.0, text[0] == '-' ? "−" + text.substr(1) : text,
             strong > 0.75 ? "cell-number strong" : "cell-number", Anchor::middle);
  }
  svg.close();
}

void draw_scale(Svg& svg, const HeatMap& map, const Layout& layout, double width, double top) {
  constexpr int middle = 5, steps = 2 * middle + 1;
  constexpr double step_px = 14.0, height = 10.0;
  const double left = std::min(layout.left, width - steps * step_px - 30.0);
  for (int i = 0; i < steps; ++i) {
    const double value = (i - middle) / static_cast<double>(middle);
    svg.rect(left + i * step_px, top, step_px, height, value < 0.0 ? "cell negative" : "cell positive",
             fmt::format("fill-opacity=\"{:.2f}\"", std::abs(value)));
  }
  svg.text(left, top + height + 13.0, "−" + number(layout.full_scale, 2), "tick", Anchor::middle);
  svg.text(left + steps * step_px / 2.0, top + height + 13.0, "0", "tick", Anchor::middle);
  svg.text(left + steps * step_px, top + height + 13.0, number(layout.full_scale, 2), "tick", Anchor::middle);
  const bool beside = width >= 500.0;
  svg.text(beside ? left + steps * step_px + 24.0 : 2.0, beside ? top + 9.0 : top - 7.0, map.scale_title, "axis");
}

}  // namespace

std::vector<LegendEntry> legend_of(const HeatMap&) {
  return {};
}

std::string draw(const HeatMap& map, double width, const std::string& id) {
  const Layout layout = layout_of(map, width);
  const double bottom = layout.top + static_cast<double>(map.rows.size()) * cell_height;
  Svg svg(id, width, bottom + scale_foot, map.title, map.description);
  for (std::size_t j = 0; j < map.columns.size(); ++j) {
    svg.turned_text(layout.left + (static_cast<double>(j) + 0.5) * layout.cell + 4.0, layout.top - 6.0, steep,
                    shortened(map.columns[j], most_column_letters), "tick", Anchor::start);
  }
  for (std::size_t i = 0; i < map.rows.size(); ++i) {
    svg.text(layout.left - 6.0, layout.top + static_cast<double>(i) * cell_height + cell_height / 2.0 + 4.0,
             shortened(map.rows[i], static_cast<int>((layout.left - 8.0) / letter_px)), "label", Anchor::end);
  }
  for (Eigen::Index i = 0; i < map.values.rows(); ++i) {
    for (Eigen::Index j = 0; j < map.values.cols(); ++j) draw_cell(svg, map, layout, i, j);
  }
  draw_scale(svg, map, layout, width, bottom + 22.0);
  return svg.markup();
}

DataTable data_of(const HeatMap& map, const std::string& corner) {
  DataTable table;
  table.columns.push_back(corner);
  table.columns.insert(table.columns.end(), map.columns.begin(), map.columns.end());
  for (Eigen::Index i = 0; i < map.values.rows(); ++i) {
    std::vector<Cell> row{map.rows[as_size(i)]};
    for (Eigen::Index j = 0; j < map.values.cols(); ++j) row.emplace_back(map.values(i, j));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace ehm::tuner_design::report
