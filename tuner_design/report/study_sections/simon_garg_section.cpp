// SPDX-License-Identifier: Apache-2.0
// Tables 4 to 7 of Simon & Garg: one table of ours and theirs, and the squared errors as bars.

#include <algorithm>

#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/study_sections/simon_garg_table_data.h"
#include "tuner_design/report/study_sections/study_sections.h"
#include "tuner_design/studies/simon_garg_table.h"

namespace ehm::tuner_design::report {
namespace {

std::string name_of(const StudyRow& row) {
  return row.group + (row.tuners.empty() ? "" : ", " + row.tuners);
}

double total(const SimonGargStudy& study, const design::ErrorByChannel& errors) {
  const Eigen::VectorXd& of = study.of_health() ? errors.health : errors.auxiliary;
  return of.size() > 0 ? of.sum() : no_number;
}

BarChart totals_of(const SimonGargStudy& study) {
  BarChart chart{
      .id = "simon-garg-totals",
      .title = "Squared error by choice of tuners",
      .description = "Squared error of the experiment as bars, theory as strokes, for each choice of tuners.",
      .categories = {},
      .series = {{"experiment", {}}},
      .marks = {{"theory", {}, Mark::tick, 2}},
      .axis_title = study.of_health() ? "squared error of health, percent²" : "squared error, mixed units",
      .logarithmic = true};
  for (const StudyRow& row : study.rows) {
    chart.categories.push_back(name_of(row));
    chart.series[0].values.push_back(total(study, row.experiment));
    chart.marks[0].values.push_back(total(study, row.theory));
  }
  return chart;
}

DataTable numbers_of(const BarChart& chart) {
  DataTable table{{"tuners", "experiment", "theory"}, {}};
  for (std::size_t i = 0; i < chart.categories.size(); ++i)
    table.rows.push_back({chart.categories[i], chart.series[0].values[i], chart.marks[0].values[i]});
  return table;
}

}  // namespace

DataTable simon_garg_table_data(const SimonGargStudy& study) {
  DataTable table{{"tuners", "row", "what"}, {}};
  for (const std::string& column : table_columns(study)) table.columns.push_back(column);
  for (const TableLine& line : table_lines(study)) {
    const bool lettered = line.tuners.size() == 1, ours = line.source == "ours";
    std::vector<Cell> row{ours ? line.group : line.source + (lettered ? "" : ": " + line.tuners),
                          lettered ? line.tuners : "", line.kind};
    row.insert(row.end(), line.values.begin(), line.values.end());
    table.rows.push_back(std::move(row));
  }
  return table;
}

Section simon_garg_section(const SimonGargStudy& study) {
  Section section{"simon-garg", "Simon & Garg, table " + std::to_string(study.options.table)};
  section.add_text("NASA/TM-2010-216077, on “" + study.model.name + "”. " + simon_garg_reading +
                   " What was flown: " + study.truth + ".");
  section.add_table("simon-garg-table", study_title(study), simon_garg_table_data(study));
  const BarChart chart = totals_of(study);
  section.add_figure("simon-garg-figure", "Squared error by choice of tuners.",
                     "A stroke at the end of its bar is theory that agrees with the experiment; a stroke without a bar "
                     "is a limit.",
                     responsive(chart), numbers_of(chart));
  return section;
}

}  // namespace ehm::tuner_design::report
