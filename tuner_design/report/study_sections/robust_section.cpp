// SPDX-License-Identifier: Apache-2.0
// What a robust gain buys on a model.

#include <fmt/format.h>

#include "tuner_design/print/studies/robust_study_text.h"
#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/line_chart.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design::report {
namespace {

DataTable errors_table(const RobustStudy& s) {
  const std::string wrong = "variance × " + fmt::format("{:g}", s.options.noise_factor);
  DataTable table{
      {"health parameter", "as modelled: standard [percent]", "as modelled: robust [percent]", "as modelled: ratio",
       wrong + ": standard [percent]", wrong + ": robust [percent]", wrong + ": ratio"},
      {}};
  for (std::size_t i = 0; i <= s.health.size(); ++i)
    table.rows.push_back({i < s.health.size() ? s.health[i] : "mean", s.standard[i], s.robust[i],
                          s.robust[i] / s.standard[i], s.standard_wrong[i], s.robust_wrong[i],
                          s.robust_wrong[i] / s.standard_wrong[i]});
  table.rows.push_back({"published mean (Kosanam, tables 5.3 and 5.2)", no_number, no_number, published_nominal_ratio,
                        no_number, no_number, published_wrong_ratio});
  return table;
}

BarChart errors_chart(const RobustStudy& s, const std::string& id, const std::string& heading,
                      const HealthErrors& standard, const HealthErrors& robust) {
  BarChart chart{
      .id = id,
      .title = "Error by health parameter, " + heading,
      .description = "Root mean square error of each health parameter with the standard and the robust gain.",
      .categories = s.health,
      .series = {{"standard gain", standard, 6, 9.0}, {"robust gain", robust, 1, 9.0}},
      .marks = {},
      .axis_title = "RMS error, percent",
      .heading = heading};
  chart.categories.emplace_back("mean");
  return chart;
}

/// What doubting one sensor is worth against doubting all.
BarChart sensors_chart(const RobustStudy& s) {
  BarChart chart{.id = "robust-sensors-bars",
                 .title = "Error where one sensor is wrong",
                 .description =
                     "Mean error over that of the standard gain where one sensor's variance is wrong: all "
                     "sensors doubted alike, or that one alone.",
                 .categories = {},
                 .series = {{"all doubted alike", {}, 6, 9.0}, {"that one alone", {}, 1, 9.0}},
                 .marks = {},
                 .axis_title = "mean error over that of the standard gain"};
  for (const DoubtedSensor& d : s.by_sensor) {
    chart.categories.push_back(d.sensor);
    chart.series[0].values.push_back(d.common / d.standard);
    chart.series[1].values.push_back(d.own / d.standard);
  }
  return chart;
}

DataTable sensors_table(const RobustStudy& s) {
  DataTable table{{"sensor that is wrong", "standard [percent]", "all doubted alike [percent]",
                   "that one alone [percent]", "alone over alike"},
                  {}};
  for (const DoubtedSensor& d : s.by_sensor)
    table.rows.push_back({d.sensor, d.standard, d.common, d.own, d.own / d.common});
  return table;
}

LineChart trade_chart(const RobustStudy& s) {
  LineChart chart{
      .id = "robust-trade-chart",
      .title = "Process part against sensor part of the error",
      .description = "Parts of the squared error from process noise and from sensor noise, over the factor mu.",
      .x = {"mu: the gain is the Kalman gain for R × mu", true},
      .y = {"part of the squared error, percent²", true},
      .series = {{"of process noise, V1", {}, {}, 2}, {"of sensor noise, V2", {}, {}, 1}}};
  for (const RobustTrade& point : s.trade) {
    chart.series[0].x.push_back(point.mu), chart.series[1].x.push_back(point.mu);
    chart.series[0].y.push_back(point.process), chart.series[1].y.push_back(point.sensor);
  }
  return chart;
}

}  // namespace

Section robust_section(const RobustStudy& s) {
  Section section{"robust", "A gain that does not trust the noise"};
  section.add_text(
      "On “" + s.model + "”, " + counted(static_cast<std::size_t>(s.tuners), "tuner") + ", Qh " +
      number(s.options.qh_percent2) + " percent² a sample. One factor mu = " + number(s.mu, 4) +
      " on all sensors' variance costs " + fmt::format("{:g}", 100.0 * s.options.nominal_loss) +
      " % where nothing is wrong. Kosanam's thesis has averages of eight parameters of another engine: they "
      "are context, no target.");
  section.add_figure(
      "robust-figure", "What the robust gain costs, and what it saves.",
      "Left the noise is the model's, right its variance is " + fmt::format("{:g}", s.options.noise_factor) +
          " times as large. The robust gain pays where the blue bar is the shorter one.",
      panels<BarChart>(
          {errors_chart(s, "robust-nominal-bars", "noise as modelled", s.standard, s.robust),
           errors_chart(s, "robust-wrong-bars", "variance × " + fmt::format("{:g}", s.options.noise_factor),
                        s.standard_wrong, s.robust_wrong)}),
      errors_table(s));
  section.add_table("robust-table", "Root mean square errors by health parameter", errors_table(s), 2);
  const BarChart sensors = sensors_chart(s);
  section.add_figure("robust-sensors", "One sensor is wrong.",
                     "At the same price where nothing is wrong: below 1 the doubt pays; the blue bar is the gain that "
                     "knows which sensor it is.",
                     responsive(sensors), sensors_table(s));
  const LineChart trade = trade_chart(s);
  section.add_figure("robust-trade", "Every trade lies on one curve.",
                     "To the right the gain trusts the sensors less: what they add falls, what the engine's own motion "
                     "leaves unseen grows.",
                     responsive(trade), data_of(trade));
  return section;
}

}  // namespace ehm::tuner_design::report
