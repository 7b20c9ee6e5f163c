// SPDX-License-Identifier: Apache-2.0
// The unscented filter where Endurthi planned one: on the pendulum, and on the turbofan itself.

#include "tuner_design/endurthi/pendulum_study.h"
#include "tuner_design/endurthi/ukf_turbofan.h"
#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design::report {
namespace {

using namespace endurthi;

BarChart pendulum_bars(const std::vector<PendulumFilter>& study) {
  BarChart chart{.id = "pendulum-bars",
                 .title = "Error of the angle by filter",
                 .description = "Root mean square error of the pendulum's angle before and after it has fallen.",
                 .categories = {},
                 .series = {{"to 1.5 s", {}, 1}, {"from 1.5 s, where it falls", {}, 2}},
                 .marks = {},
                 .axis_title = "RMS error of the angle, rad",
                 .logarithmic = true};
  for (const PendulumFilter& f : study) {
    chart.categories.push_back(f.name);
    chart.series[0].values.push_back(f.angle_before_rad);
    chart.series[1].values.push_back(f.angle_after_rad);
  }
  return chart;
}

DataTable pendulum_table(const std::vector<PendulumFilter>& study) {
  DataTable table{
      {"filter", "angle to 1.5 s [rad]", "angle from 1.5 s [rad]", "position to 1.5 s [m]", "position from 1.5 s [m]"},
      {}};
  for (const PendulumFilter& f : study)
    table.rows.push_back({f.name, f.angle_before_rad, f.angle_after_rad, f.position_before_m, f.position_after_m});
  return table;
}

BarChart turbofan_bars(const TurbofanPoint& point, std::size_t number) {
  BarChart chart{.id = "turbofan-bars-" + std::to_string(number),
                 .title = "Error of health by filter, " + point.name,
                 .description = "Root mean square error of each health parameter by both filters.",
                 .categories = point.health,
                 .series = {},
                 .marks = {},
                 .axis_title = "RMS error, % of nominal",
                 .heading = point.name};
  chart.categories.emplace_back("mean");
  int colour = 0;
  for (const TurbofanFilter& f : point.filters) chart.series.push_back({f.name, f.errors.percent, ++colour, 9.0});
  return chart;
}

DataTable turbofan_table(const std::vector<TurbofanPoint>& study) {
  DataTable table{{"point", "filter", "mean error [% of nominal]", "mean error [% of change]", "coverage [%]",
                   "samples without an answer", "time of all runs [s]"},
                  {}};
  for (const TurbofanPoint& point : study)
    for (const TurbofanFilter& f : point.filters)
      table.rows.push_back({point.name, f.name, f.errors.percent.back(), f.errors.of_change.back(), 100.0 * f.coverage,
                            static_cast<double>(f.lost), f.seconds});
  return table;
}

DataTable turbofan_errors(const std::vector<TurbofanPoint>& study) {
  DataTable table{{"point", "filter", "health parameter", "RMS error [% of nominal]"}, {}};
  for (const TurbofanPoint& point : study)
    for (const TurbofanFilter& f : point.filters)
      for (std::size_t i = 0; i < f.errors.percent.size(); ++i)
        table.rows.push_back(
            {point.name, f.name, i < point.health.size() ? point.health[i] : "mean", f.errors.percent[i]});
  return table;
}

}  // namespace

Section pendulum_section(const std::vector<PendulumFilter>& study) {
  Section section{"pendulum", "Endurthi: the unscented filter on a pendulum"};
  section.add_text(
      "A pendulum on a cart, its position measured every 5 ms for 3 s; it falls through π near 1.3 s. The "
      "thesis finds the unscented filter better from 1.5 s on, and prints the Jacobian of the upright "
      "pendulum. Beside that one stands the extended filter whose Jacobian is taken at the estimate.");
  const BarChart bars = pendulum_bars(study);
  section.add_figure(
      "pendulum-figure", "Error of the angle.",
      "The thesis' extended filter is the one named upright: it was the Jacobian, not the filter, if the "
      "other extended filter is as good as the unscented ones.",
      responsive(bars), pendulum_table(study));
  section.add_table("pendulum-table", "Root mean square errors of angle and of the cart's position",
                    pendulum_table(study));
  return section;
}

Section turbofan_section(const std::vector<TurbofanPoint>& study) {
  Section section{"turbofan", "Endurthi: the unscented filter on the turbofan"};
  section.add_text(
      "Planned in the thesis, estimated there at 472 hours, and never run: health by filters on the nonlinear "
      "engine itself, flights of 3 s. There is no published number. Times are of the clock and of one "
      "core: they alone are not the same in every run.");
  std::vector<BarChart> charts;
  for (const TurbofanPoint& point : study) charts.push_back(turbofan_bars(point, charts.size() + 1));
  section.add_figure(
      "turbofan-figure", "Error of health by filter.",
      "Bars of one pair are equally long where the unscented filter is worth nothing beside the extended "
      "one.",
      panels(charts), turbofan_errors(study));
  section.add_table("turbofan-table", "Means over the health parameters, honesty and time", turbofan_table(study));
  return section;
}

}  // namespace ehm::tuner_design::report
