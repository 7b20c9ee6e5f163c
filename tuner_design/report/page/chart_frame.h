// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the charts share: the two widths in which each is drawn (the page shows the one that fits the screen), the size
// of letters, and the legend. Source of the colours: Okabe & Ito, "Color Universal Design" (2008), darkened to a
// contrast of 3:1 and more; marks differ in shape or place too, never in colour alone.

#include <string>
#include <vector>

namespace ehm::tuner_design::report {

inline constexpr double wide_px = 760.0, narrow_px = 340.0;
inline constexpr double letter_px = 6.9, tick_letter_px = 6.3, heading_letter_px = 7.6, line_px = 15.0;
inline constexpr double heading_room = 20.0;

/// What a legend shows before the name; the number chooses the colour, 1 to 6.
enum class Mark { bar, line, dashed_line, circle, tick, diamond };

struct LegendEntry {
  Mark mark;
  int colour;
  std::string name;
};

/// A list in HTML; nothing for less than two entries: the title says what the only one is.
std::string legend(const std::vector<LegendEntry>& entries);

/// Both drawings of a chart for which `draw(chart, width, id)` exists, and its legend.
template <typename Chart>
std::string responsive(const Chart& chart) {
  return legend(legend_of(chart)) + "<div class=\"wide\">" + draw(chart, wide_px, chart.id + "-wide") +
         "</div><div class=\"narrow\">" + draw(chart, narrow_px, chart.id + "-narrow") + "</div>";
}

/// Charts side by side where the screen is wide enough, with one legend.
template <typename Chart>
std::string panels(const std::vector<Chart>& charts) {
  std::string html = charts.empty() ? "" : legend(legend_of(charts.front()));
  html += "<div class=\"panels\">";
  for (const Chart& chart : charts) html += "<div>" + draw(chart, narrow_px, chart.id) + "</div>";
  return html + "</div>";
}

}  // namespace ehm::tuner_design::report
