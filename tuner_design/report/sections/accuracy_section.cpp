// SPDX-License-Identifier: Apache-2.0
// Errors against the limit, in total and by channel.

#include <cmath>
#include <map>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/report/comparison.h"
#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/html_table.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/sections/sections.h"

namespace ehm::tuner_design::report {
namespace {

std::vector<double> roots_of(const Eigen::VectorXd& variances) {
  return values_of(variances.cwiseSqrt());
}

BarChart sigma_chart(const ErrorParts& parts, const std::vector<std::string>& names, const std::string& id,
                     const std::string& title, const std::string& unit) {
  BarChart chart{.id = id,
                 .title = title,
                 .description = "Standard deviation of the estimate of each channel in " + unit +
                                ", with its parts, the fleet's own and the Bayes limit.",
                 .categories = names,
                 .series = {},
                 .marks = {},
                 .axis_title = "standard deviation, " + unit};
  chart.series.push_back({.name = "sigma total, as published", .values = roots_of(parts.total)});
  chart.series.push_back({"of it unseen by the sensors", roots_of(parts.unseen), 2, 4.5, false});
  chart.series.push_back({"of it noise", roots_of(parts.noise), 3, 4.5, false});
  if (parts.linearisation.sum() > 0.0)
    chart.series.push_back({"of it linearisation", roots_of(parts.linearisation), 4, 4.5, false});
  chart.marks.push_back({"the fleet's own (prior)", roots_of(parts.prior), Mark::diamond, 6});
  chart.marks.push_back({"Bayes limit", roots_of(parts.limit), Mark::tick, 5});
  return chart;
}

DataTable channel_table(const ErrorParts& parts, const std::vector<std::string>& names,
                        const std::vector<std::string>& units) {
  DataTable table{{"channel", "unit", "sigma total", "unseen", "noise", "linearisation", "limit", "prior",
                   "variance explained [%]"},
                  {}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto at = as_index(i);
    const double explained = parts.prior(at) > 0.0 ? 100.0 * (1.0 - parts.total(at) / parts.prior(at)) : no_number;
    table.rows.push_back({names[i], units[i], std::sqrt(parts.total(at)), std::sqrt(parts.unseen(at)),
                          std::sqrt(parts.noise(at)), std::sqrt(parts.linearisation(at)), std::sqrt(parts.limit(at)),
                          std::sqrt(parts.prior(at)), explained});
  }
  return table;
}

/// Channels that share a reporting unit can share an axis.
ErrorParts chosen(const ErrorParts& parts, const std::vector<int>& rows) {
  return {parts.unseen(rows), parts.noise(rows), parts.linearisation(rows),
          parts.total(rows),  parts.prior(rows), parts.limit(rows)};
}

void add_health(Section& section, const ReportData& data) {
  const auto names = names_of(data.design.model.health);
  const BarChart chart =
      sigma_chart(data.health, names, "sigma-health", "Health parameters: standard deviations", "percent");
  const DataTable table = channel_table(data.health, names, std::vector<std::string>(names.size(), "percent"));
  section.add_figure(
      chart.id, "Health parameters: sigma total and what it is made of.",
      "The wide bar is the published standard deviation; the thin bars are its parts, which add as squares. A bar "
      "that reaches the diamond tells nothing that the fleet did not tell before; the upright stroke is what no "
      "estimator can pass.",
      responsive(chart) +
          html_table(table, "Health parameters: standard deviations and the variance that the sensors explain"),
      table);
}

void add_auxiliary(Section& section, const ReportData& data) {
  const auto names = names_of(data.design.model.auxiliary);
  if (names.empty()) return;
  std::map<std::string, std::vector<int>> by_unit;
  for (std::size_t i = 0; i < names.size(); ++i)
    by_unit[data.design.scaling.auxiliary_unit[i]].push_back(static_cast<int>(i));
  std::vector<BarChart> charts;
  for (const auto& [unit, rows] : by_unit) {
    std::vector<std::string> part_names;
    for (const int row : rows) part_names.push_back(names[as_size(row)]);
    charts.push_back(sigma_chart(chosen(data.auxiliary, rows), part_names, "sigma-auxiliary-" + unit,
                                 "Auxiliary outputs in " + unit, unit == "percent" ? "percent of trim" : unit));
  }
  const DataTable table = channel_table(data.auxiliary, names, data.design.scaling.auxiliary_unit);
  section.add_figure(
      "sigma-auxiliary", "Auxiliary outputs: sigma total and what it is made of.",
      "As above, one drawing for each unit.",
      panels(charts) +
          html_table(table, "Auxiliary outputs: standard deviations and the variance that the sensors explain"),
      table);
}

}  // namespace

Section accuracy_section(const ReportData& data) {
  Section section{"accuracy", "Accuracy against the limit"};
  section.add_text(
      "Errors are expected values over a fleet of engines whose health scatters as the model states. The Bayes limit "
      "is what remains when all noise is averaged out: the part of health that these sensors cannot show at this "
      "operating point. Noise is that of the sensors and that of the engine itself, whose states move by the model's "
      "process noise.");
  add_comparison(section, data);
  add_health(section, data);
  add_auxiliary(section, data);
  return section;
}

}  // namespace ehm::tuner_design::report
