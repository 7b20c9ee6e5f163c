// SPDX-License-Identifier: Apache-2.0
// Theory against experiment: what the Monte Carlo found (tuner_design/monte_carlo/evaluation.h).

#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/html_table.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/sections/sections.h"

namespace ehm::tuner_design::report {
namespace {

constexpr double wide_bounds = 2.0;  ///< standard errors

std::string name_of(const Experiment& experiment) {
  return experiment.estimator + (experiment.nonlinear ? ", nonlinear engine" : ", linear engine");
}

std::vector<std::string> channels_of(const design::Design& design) {
  std::vector<std::string> names = names_of(design.model.health);
  for (const std::string& name : names_of(design.model.auxiliary)) names.push_back(name);
  return names;
}

Eigen::VectorXd joined(const design::ErrorByChannel& errors) {
  Eigen::VectorXd all(errors.health.size() + errors.auxiliary.size());
  all << errors.health, errors.auxiliary;
  return all;
}

DataTable totals_table(const std::vector<Experiment>& experiments, bool auxiliary) {
  DataTable table{{"estimator and truth", "engines", "errors of", "theory", "of it linearisation", "experiment", "s.e.",
                   "difference [s.e.]"},
                  {}};
  const auto add = [&](const Experiment& e, const std::string& of, double theory, double linearisation,
                       double experiment, double standard_error) {
    table.rows.push_back({name_of(e), static_cast<double>(e.engines), of, theory, linearisation, experiment,
                          standard_error, (experiment - theory) / standard_error});
  };
  for (const Experiment& e : experiments)
    add(e, "health", e.theory_health(), e.linearisation.health.sum(), e.experiment.health.sum(),
        e.standard_error_of_total.health);
  for (const Experiment& e : experiments) {
    if (auxiliary)
      add(e, "auxiliary", e.theory_auxiliary(), e.linearisation.auxiliary.sum(), e.experiment.auxiliary.sum(),
          e.standard_error_of_total.auxiliary);
  }
  return table;
}

BarChart ratio_chart(const Experiment& experiment, const std::vector<std::string>& channels, std::size_t number) {
  const Eigen::VectorXd theory = joined(experiment.theory) + joined(experiment.linearisation);
  const Eigen::VectorXd bounds = wide_bounds * joined(experiment.standard_error).cwiseQuotient(theory);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(theory.size());
  BarChart chart{
      .id = "experiment-" + std::to_string(number + 1),
      .title = "Experiment over theory: " + name_of(experiment),
      .description =
          "Squared error of the experiment divided by theory, by channel, with the bounds of two standard errors "
          "around theory.",
      .categories = channels,
      .series = {{"experiment / theory", values_of(joined(experiment.experiment).cwiseQuotient(theory)), 1, 10.0}},
      .marks = {},
      .axis_title = "squared error, experiment / theory",
      .heading = name_of(experiment)};
  chart.marks.push_back({"theory − 2 standard errors", values_of(one - bounds), Mark::tick, 5});
  chart.marks.push_back({"theory + 2 standard errors", values_of(one + bounds), Mark::tick, 2});
  return chart;
}

DataTable channel_table(const std::vector<Experiment>& experiments, const std::vector<std::string>& channels) {
  DataTable table{{"estimator and truth", "channel", "theory", "of it linearisation", "experiment", "standard error",
                   "settled theory, linear engine"},
                  {}};
  for (const Experiment& e : experiments) {
    const Eigen::VectorXd linearisation = joined(e.linearisation), theory = joined(e.theory) + linearisation;
    const Eigen::VectorXd experiment = joined(e.experiment), error = joined(e.standard_error), end = joined(e.settled);
    for (Eigen::Index i = 0; i < theory.size(); ++i)
      table.rows.push_back(
          {name_of(e), channels[as_size(i)], theory(i), linearisation(i), experiment(i), error(i), end(i)});
  }
  return table;
}

void add_coverage(Section& section, const std::vector<Experiment>& experiments,
                  const std::vector<std::string>& channels) {
  DataTable table{{"channel"}, {}};
  for (const std::string& channel : channels) table.rows.push_back({channel});
  table.rows.push_back({"mean of all channels"});
  for (const Experiment& e : experiments) {
    if (e.coverage.health.size() == 0) continue;
    table.columns.push_back(std::string(e.nonlinear ? "nonlinear engine" : "linear engine") + " [%]");
    table.columns.emplace_back("standard error [%]");
    const Eigen::VectorXd coverage = 100.0 * joined(e.coverage), error = 100.0 * joined(e.coverage_standard_error);
    for (Eigen::Index i = 0; i < coverage.size(); ++i) {
      auto& row = table.rows[as_size(i)];
      row.insert(row.end(), {coverage(i), error(i)});
    }
    table.rows.back().insert(table.rows.back().end(), {coverage.mean(), no_number});
  }
  if (table.columns.size() > 1)
    section.add_table("coverage",
                      "Share of the time that the truth lies within the published ±1.96 sigma total, 95 % if the "
                      "sigma is right and the errors are normal",
                      table, 1);
}

}  // namespace

Section evaluation_section(const ReportData& data) {
  Section section{"experiment", "Theory against experiment"};
  for (const std::string& reason : data.studies.not_flown) section.add_text(reason);
  const std::vector<Experiment>& experiments = data.studies.experiments;
  if (experiments.empty()) return section;
  section.add_text(
      "The monitor's own filter flew on many engines with health drawn from the fleet; theory is that of the same "
      "time window from the same cold start.");
  const std::vector<std::string> channels = channels_of(data.design);
  std::vector<BarChart> charts;
  std::string truths;
  for (const Experiment& experiment : experiments) {
    truths += (truths.empty() ? "" : "; ") + name_of(experiment) + ": " + experiment.truth;
    if (experiment.coverage.health.size() > 0) charts.push_back(ratio_chart(experiment, channels, charts.size()));
  }
  section.add_text("What was flown: " + truths + ".");
  section.add_table("experiment-totals",
                    "Squared errors summed over channels (health in percent², auxiliary outputs in mixed units), "
                    "theory and experiment; s.e. is the standard error of the experiment",
                    totals_table(experiments, !data.design.model.auxiliary.empty()));
  section.add_figure(
      "experiments", "The filter's experiment over theory by channel.",
      "A bar that ends between the two strokes agrees with theory within two standard errors of the Monte Carlo; "
      "about one in twenty may miss them by chance.",
      panels(charts), channel_table(experiments, channels));
  add_coverage(section, experiments, channels);
  return section;
}

}  // namespace ehm::tuner_design::report
