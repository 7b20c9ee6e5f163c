// SPDX-License-Identifier: Apache-2.0
// Lu, Huang & Lv: the tables, and the sums of errors as bars.

#include <algorithm>

#include "tuner_design/lu/published_beside.h"
#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/study_sections/lu_figures.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design::report {
namespace {

constexpr int gradual_table = 6, cost_table = 7;

std::string name_of(const LuCase& c) {
  return c.what + ", " + filter_name(c);
}

/// Means and standard deviations of every parameter, the paper's below ours.
DataTable parameter_table(const LuStudy& study) {
  DataTable table{{"case", "filter", "what"}, {}};
  for (const char* name : lu_health_names) table.columns.push_back(std::string(name) + " [%]");
  table.columns.insert(table.columns.end(), {"SME [%]", "spread of SME [%]"});
  const auto add = [&](const LuCase& c, const std::string& what, const auto& values, double sme, double spread) {
    std::vector<Cell> row{c.what, filter_name(c), what};
    row.insert(row.end(), values.begin(), values.end());
    row.insert(row.end(), {sme, spread});
    table.rows.push_back(std::move(row));
  };
  for (const LuCase& c : study.cases) {
    add(c, "ours, mean error", std::vector<double>(c.mean_rms.begin(), c.mean_rms.end()), c.sme, c.sme_spread);
    add(c, "ours, standard deviation", std::vector<double>(c.sigma_rms.begin(), c.sigma_rms.end()), no_number,
        no_number);
    if (const published::Lu* theirs = published_parameters(study, c)) {
      add(c, "published, mean error", theirs->mean, sum_of_means(*theirs), no_number);
      add(c, "published, standard deviation", theirs->sigma, no_number, no_number);
    }
  }
  return table;
}

double published_total(const LuStudy& study, std::size_t index) {
  if (const published::Lu* theirs = published_parameters(study, study.cases[index])) return sum_of_means(*theirs);
  return published_figure(study, index).value_or(no_number);
}

/// One figure of merit a case: SME, or seconds.
DataTable figure_table(const LuStudy& study) {
  const bool cost = study.options.table == cost_table;
  DataTable table{{"case", "filter", cost ? "ours [s a s]" : "ours, SME [%]", "spread over the runs [%]",
                   "runs that diverged", cost ? "published [s a s]" : "published, SME [%]"},
                  {}};
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const LuCase& c = study.cases[i];
    const double theirs = published_total(study, i);
    std::vector<Cell> row{c.what, filter_name(c), cost ? c.seconds : c.sme, cost ? no_number : c.sme_spread,
                          static_cast<double>(c.diverged)};
    if (theirs < 0.0)
      row.emplace_back("diverged");
    else
      row.emplace_back(theirs);
    table.rows.push_back(std::move(row));
  }
  return table;
}

BarChart bars_of(const LuStudy& study) {
  const bool cost = study.options.table == cost_table;
  BarChart chart{
      .id = "lu-" + std::to_string(study.options.table) + "-bars",
      .title = cost ? "Cost by case and filter" : "Sum of mean errors by case and filter",
      .description = "Bars are ours, diamonds the published figures.",
      .categories = {},
      .series = {{"ours", {}}},
      .marks = {{"published", {}, Mark::diamond, 2}},
      .axis_title = cost ? "seconds of one core a second of data" : "SME: sum of the mean errors, % of nominal",
      .logarithmic = true};
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const LuCase& c = study.cases[i];
    const bool lost = c.diverged == study.options.runs;
    chart.categories.push_back(name_of(c));
    chart.series[0].values.push_back(cost ? c.seconds : lost ? no_number : c.sme);
    chart.marks[0].values.push_back(std::max(0.0, published_total(study, i)));
  }
  return chart;
}

std::string set_up(const LuStudy& study) {
  const LuOptions& o = study.options;
  return "On " + o.engine->data.name + " at sea level, static, " + quantity(study.fuel_flow_kg_s, "kg/s", 4) +
         " of fuel (theirs: 2.5), " + counted(o.runs, "run") +
         " of each case where the paper has one, N = " + std::to_string(o.particles) +
         ". Errors of health in percent of nominal over " +
         (o.table == gradual_table ? "the last 2 s of each of 21 points of wear" : "samples 401 to 500") +
         "; means and standard deviations are root mean squares over the runs, and SME is the sum of the seven mean "
         "errors" +
         (o.table == gradual_table ? ", of all points" : "") +
         ". Their engine is another one: the published numbers are context, no target.";
}

}  // namespace

Section lu_section(const LuStudy& study) {
  const std::string name = "lu-" + std::to_string(study.options.table);
  Section section{name, "Lu, Huang & Lv, table " + std::to_string(study.options.table)};
  section.add_text(set_up(study));
  if (study.options.table == cost_table)
    section.add_text("Seconds are of the clock: they alone are not the same in every run.");
  const BarChart bars = bars_of(study);
  section.add_figure(
      name + "-figure", study.options.table == cost_table ? "Cost." : "Sum of mean errors.",
      "Bars are ours, diamonds are published; a case without a diamond is not in the paper, or the filter "
      "diverged there.",
      responsive(bars), figure_table(study));
  add_lu_figures(section, study);
  if (study.options.table <= 5)
    section.add_table(name + "-table", "Table " + std::to_string(study.options.table) + ": errors by health parameter",
                      parameter_table(study));
  else
    section.add_table(name + "-table", "Table " + std::to_string(study.options.table) + ", ours and published",
                      figure_table(study));
  return section;
}

}  // namespace ehm::tuner_design::report
