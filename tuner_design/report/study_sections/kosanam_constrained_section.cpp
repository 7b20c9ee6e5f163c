// SPDX-License-Identifier: Apache-2.0
// Kosanam's table 5.1 and figures 5.1 to 5.3: a Kalman filter that knows that health does not improve.

#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/kosanam/constrained_tables.h"
#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/line_chart.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/study_sections/kosanam_set_up.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design::report {
namespace {

/// The published number of a parameter, where there are as many as in the thesis.
double published(const ConstrainedTables& t, std::size_t parameter, std::size_t column) {
  return t.health.size() == published_5_1.size() ? published_5_1[parameter][column] : no_number;
}

DataTable table_5_1(const ConstrainedTables& t) {
  using namespace constrained_case;
  const BatchResult& r = t.table();
  DataTable table{{"health parameter", "published, Kalman [% of change]", "published, constrained [% of change]",
                   "published ratio", "ours, Kalman [% of change]", "ours, W = I [% of change]", "W = I ratio",
                   "ours, W = P⁻¹ [% of change]", "W = P⁻¹ ratio"},
                  {}};
  const auto add = [&](const std::string& name, double theirs, double constrained, double ours, double by_identity,
                       double by_covariance) {
    table.rows.push_back({name, theirs, constrained, constrained / theirs, ours, by_identity, by_identity / ours,
                          by_covariance, by_covariance / ours});
  };
  for (std::size_t i = 0; i < t.health.size(); ++i)
    add(t.health[i], published(t, i, 0), published(t, i, 1), r.of_change(kalman, as_index(i)),
        r.of_change(identity, as_index(i)), r.of_change(projection, as_index(i)));
  add("average", published_5_1_average[0], published_5_1_average[1], r.of_change(kalman), r.of_change(identity),
      r.of_change(projection));
  return table;
}

BarSeries series_of(const ConstrainedTables& t, const std::string& name, constrained_case::Case filter, int colour) {
  BarSeries series{name, {}, colour, 10.0};
  for (std::size_t i = 0; i < t.health.size(); ++i) series.values.push_back(t.table().of_change(filter, as_index(i)));
  series.values.push_back(t.table().of_change(filter));
  return series;
}

BarMark mark_of(const ConstrainedTables& t, const std::string& name, std::size_t column, Mark mark, int colour) {
  BarMark marks{name, {}, mark, colour};
  for (std::size_t i = 0; i < t.health.size(); ++i) marks.values.push_back(published(t, i, column));
  marks.values.push_back(published_5_1_average[column]);
  return marks;
}

BarChart bars_of(const ConstrainedTables& t, const std::string& id, std::vector<BarSeries> series,
                 std::vector<BarMark> marks) {
  BarChart chart{.id = id,
                 .title = "Error by health parameter",
                 .description = "Root mean square error of each health parameter in percent of its true change.",
                 .categories = t.health,
                 .series = std::move(series),
                 .marks = std::move(marks),
                 .axis_title = "RMS error, % of the true change"};
  chart.categories.emplace_back("average");
  return chart;
}

DataTable numbers_of(const BarChart& chart) {
  DataTable table{{"health parameter"}, {}};
  for (const BarSeries& series : chart.series) table.columns.push_back(series.name + " [% of change]");
  for (std::size_t i = 0; i < chart.categories.size(); ++i) {
    std::vector<Cell> row{chart.categories[i]};
    for (const BarSeries& series : chart.series) row.emplace_back(series.values[i]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// As much as a drawing shows.
double rounded(double percent) {
  return std::round(1e4 * percent) / 1e4;
}

void add_estimates(Section& section, const ConstrainedTables& t, const std::string& id, const std::string& title,
                   constrained_case::Case filter) {
  const BatchResult& r = t.table();
  const Eigen::MatrixXd& estimates = r.filters[filter].first_run;
  std::vector<LineChart> charts;
  DataTable table{{"health parameter", "flight", "truth [%]", "estimate [%]"}, {}};
  for (std::size_t i = 0; i < t.health.size(); ++i) {
    LineSeries estimate{"estimate", {}, {}, 1, Mark::line, true}, truth{"truth", {}, {}, 6, Mark::dashed_line};
    for (Eigen::Index flight = 0; flight < estimates.cols(); ++flight) {
      const double number = static_cast<double>(flight + 1), h = rounded(estimates(as_index(i), flight));
      estimate.x.push_back(number), truth.x.push_back(number);
      estimate.y.push_back(h), truth.y.push_back(rounded(r.truth(as_index(i), flight)));
      table.rows.push_back({t.health[i], number, truth.y.back(), h});
    }
    charts.push_back({.id = id + "-" + std::to_string(i + 1),
                      .title = t.health[i] + " over the flights",
                      .description = "Estimate at the end of each flight and the true change of " + t.health[i] + ".",
                      .x = {"flight"},
                      .y = {"change, % of nominal", false, true},
                      .series = {estimate, truth},
                      .height_px = 190.0,
                      .heading = t.health[i]});
  }
  section.add_figure(
      id, title,
      "One engine, the estimate at the end of each flight, a drawing a parameter; the dashed line is the "
      "true change. Scales differ.",
      panels(charts), std::move(table));
}

DataTable filters_table(const ConstrainedTables& t) {
  const BatchResult& r = t.table();
  DataTable table{{"filter", "RMS error [% of nominal]", "RMS error [% of change]", "over the plain filter",
                   "bias, the way of wear [% of nominal]", "coverage [%]"},
                  {}};
  for (std::size_t f = 0; f < r.filters.size(); ++f)
    table.rows.push_back({r.filters[f].name, r.mean_rms(f), r.of_change(f),
                          r.mean_rms(f) / r.mean_rms(constrained_case::kalman), r.filters[f].bias.mean(),
                          100.0 * r.filters[f].coverage.mean()});
  return table;
}

/// The ratchet: what each constraint errs over the random walk's variance.
LineChart sweep_of(const ConstrainedTables& t) {
  using namespace constrained_case;
  LineChart chart{.id = "kosanam-5-1-sweep-chart",
                  .title = "Error over the random walk's variance",
                  .description = "Mean error of the plain filter and of constrained ones over qh.",
                  .x = {"qh over that of the model file", true},
                  .y = {"mean RMS error, % of nominal", true},
                  .series = {}};
  int colour = 0;
  for (const Case f :
       {kalman, identity, projection, identity_fed_back, projection_behind_fed_back, truncation_2_behind}) {
    LineSeries line{t.table().filters[f].name, {}, {}, ++colour, f == kalman ? Mark::dashed_line : Mark::line};
    for (const SweepPoint& point : t.sweep) {
      line.x.push_back(point.factor);
      line.y.push_back(point.result.mean_rms(f));
    }
    chart.series.push_back(std::move(line));
  }
  return chart;
}

}  // namespace

Section constrained_section(const ConstrainedTables& t) {
  using namespace constrained_case;
  Section section{"kosanam-5-1", "Kosanam, table 5.1: health does not improve"};
  section.add_text(
      kosanam_set_up(t.model, t.options.batch, t.options.health_variance * t.sweep[t.best].factor, t.not_known));
  section.add_text(
      "Of the filters that constrain, W = I is the nearest point by each parameter itself, W = P⁻¹ that by "
      "the filter's covariance. The thesis does not say which it has; both are here.");
  section.add_table("kosanam-5-1-table", "Table 5.1: RMS errors of health, published beside ours", table_5_1(t), 1);
  const BarChart bars = bars_of(
      t, "kosanam-5-1-bars", {series_of(t, "ours, Kalman", kalman, 6), series_of(t, "ours, W = I", identity, 1)},
      {mark_of(t, "published, Kalman", 0, Mark::tick, 5), mark_of(t, "published, constrained", 1, Mark::diamond, 2)});
  section.add_figure(
      "kosanam-5-1-figure", "Table 5.1 as bars.",
      "The constraint pays where the blue bar is shorter than the grey one. Strokes and diamonds are the "
      "published errors, of another engine.",
      responsive(bars), numbers_of(bars));
  const BarChart steady =
      bars_of(t, "kosanam-5-1-steady-bars",
              {series_of(t, "steady gain", kalman, 6), series_of(t, "time-varying gain", time_varying, 3)}, {});
  section.add_figure("kosanam-5-1-steady", "The thesis' figure 5.1: steady against time-varying filter.",
                     "Bars of one pair are equally long where the steady filter is as good; over all parameters the "
                     "time-varying one has " +
                         number(t.ratio(time_varying)) + " of its error.",
                     responsive(steady), numbers_of(steady));
  add_estimates(section, t, "kosanam-5-1-plain", "The thesis' figure 5.2: unconstrained estimates.", kalman);
  add_estimates(section, t, "kosanam-5-1-constrained", "The thesis' figure 5.3: constrained estimates (W = I).",
                identity);
  const LineChart sweep = sweep_of(t);
  section.add_figure(
      "kosanam-5-1-sweep", "The ratchet over the random walk's variance (not in the thesis).",
      "A constrained filter is worth something where its line lies below the dashed one. The table above "
      "is that of the qh at which the plain filter errs least.",
      responsive(sweep), data_of(sweep));
  section.add_table("kosanam-5-1-filters",
                    "All filters, means over the parameters; coverage of ±1.96 sigma, 95 % is honest",
                    filters_table(t));
  return section;
}

}  // namespace ehm::tuner_design::report
