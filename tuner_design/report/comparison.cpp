// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/comparison.h"

#include <algorithm>
#include <map>

#include "tuner_design/report/limit_ratio.h"
#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/html_table.h"

namespace ehm::tuner_design::report {
namespace {

struct Compared {
  std::string name, description;
  double health, auxiliary, time_constant_s;
};

/// Those that a Design does not hold itself.
const std::map<std::string, std::string> baseline_names{{"closed_form", "Kalman filter on H Ph"},
                                                        {"best_subset", "Kalman filter on the best subset"},
                                                        {"published_subset", "Kalman filter on the published subset"},
                                                        {"svd", "Kalman filter on the SVD of [H; Hz]"},
                                                        {"gauss_markov", "Full-order filter, steady"},
                                                        {"time_varying", "Full-order filter, time-varying"}};

std::vector<Compared> from_worst_to_best(const ReportData& data) {
  const design::Design& design = data.design;
  const auto from = [](const std::string& name, const std::string& description, const design::ErrorByChannel& error,
                       double time_constant_s = no_number) {
    return Compared{name, description, error.health.sum(), error.auxiliary.sum(), time_constant_s};
  };
  std::vector<Compared> all{
      from("Fleet knowledge only", "no sensors", {data.health.prior, data.auxiliary.prior}),
      from("Full-order MAP", "one noisy snapshot", design.full_map),
      from("MAP on the tuners", "one noisy snapshot", design.reduced_map),
      from("This design, with nonlinearity", "what the linear model misses is added",
           {data.health.total, data.auxiliary.total}, design.full.slowest_time_constant_s),
      from("This design", "on the linear engine, whose limit is lower where the model knows what it misses",
           design.ssee, design.full.slowest_time_constant_s)};
  for (const Baseline& baseline : data.studies.baselines) {
    const auto known = baseline_names.find(baseline.name);
    if (known != baseline_names.end())
      all.push_back(from(known->second, baseline.description, baseline.error,
                         baseline.slowest_time_constant_s.value_or(no_number)));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.health > b.health; });
  all.push_back(from("Bayes limit", "endless averaging of these sensors at this point", design.bayes_limit));
  return all;
}

double ratio(double ssee, double limit) {
  return has_limit(ssee, limit) ? ssee / limit : no_number;
}

BarChart chart_of(const std::vector<Compared>& all, const ReportData& data) {
  const double limit_h = data.health.limit.sum(), limit_z = data.auxiliary.limit.sum();
  const bool over_limit = has_limit(data.design.ssee.health.sum(), limit_h);
  BarChart chart{
      .id = "comparison",
      .title = "The design and what it is compared with",
      .description = over_limit ? "Squared errors over the Bayes limit on a logarithmic axis."
                                : "Squared error of health on a logarithmic axis.",
      .categories = {},
      .series = {{"health", {}, 1, 11.0}},
      .marks = {},
      .axis_title = over_limit ? "squared error / Bayes limit (logarithmic)" : "SSEE(h), percent² (logarithmic)",
      .logarithmic = true};
  const bool auxiliary = over_limit && has_limit(data.design.ssee.auxiliary.sum(), limit_z);
  if (auxiliary) chart.series.push_back({"auxiliary outputs", {}, 2, 11.0});
  for (const Compared& one : all) {
    if (!over_limit && one.name == "Bayes limit") continue;
    chart.categories.push_back(one.name);
    chart.series[0].values.push_back(over_limit ? one.health / limit_h : one.health);
    if (auxiliary) chart.series[1].values.push_back(one.auxiliary / limit_z);
  }
  return chart;
}

}  // namespace

void add_comparison(Section& section, const ReportData& data) {
  const std::vector<Compared> all = from_worst_to_best(data);
  const bool auxiliary = !data.design.model.auxiliary.empty();
  DataTable table{{"estimator", "what it is", "SSEE(h) [percent²]", "SSEE(h) / limit"}, {}};
  if (auxiliary) table.columns.insert(table.columns.end(), {"SSEE(z) [mixed]", "SSEE(z) / limit"});
  table.columns.emplace_back("slowest time constant [s]");
  for (const Compared& one : all) {
    std::vector<Cell> row{one.name, one.description, one.health, ratio(one.health, data.health.limit.sum())};
    if (auxiliary) row.insert(row.end(), {one.auxiliary, ratio(one.auxiliary, data.auxiliary.limit.sum())});
    row.emplace_back(one.time_constant_s);
    table.rows.push_back(std::move(row));
  }
  const BarChart chart = chart_of(all, data);
  section.add_figure(
      "totals", "The design and what it is compared with, from the worst to the best.",
      "Short bars are good; a bar of length zero stands at the Bayes limit, which nothing passes that sees steady "
      "data of this operating point.",
      responsive(chart) + html_table(table,
                                     "Sum of squared errors (SSEE), expected over the fleet; z adds K², percent² and "
                                     "points²"),
      table);
}

}  // namespace ehm::tuner_design::report
