// SPDX-License-Identifier: Apache-2.0
// Every estimator in every case, at a glance: error, honesty and cost.

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/family/family_study.h"
#include "tuner_design/report/page/score_matrix.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design::report {
namespace {

constexpr double honest_coverage = 0.9;

std::string name_of(FamilyCase what) {
  return family_case_names[as_size(static_cast<int>(what))];
}

/// Least over the cases at the point; not a number where it flew none.
double step_us(const FamilyStudy& study, std::size_t estimator) {
  double least = no_number;
  for (const FamilyCaseResult& c : study.cases) {
    const auto& score = c.scores[estimator];
    if (score && c.what != FamilyCase::flight && !(least <= score->step_us)) least = score->step_us;
  }
  return least;
}

ScoreMatrix matrix_of(const FamilyStudy& study) {
  const Eigen::Index rows = as_index(study.estimators.size()), columns = as_index(study.cases.size());
  ScoreMatrix matrix{
      .id = "family-matrix",
      .title = "Every estimator in every case",
      .description =
          "Squared error of health of each estimator in each case over the limit of a constant engine, with a "
          "mark where the stated sigma is too small, and the time that a sample costs.",
      .rows = study.estimators,
      .columns = {},
      .values = Eigen::MatrixXd::Constant(rows, columns, no_number),
      .marked = Eigen::MatrixXi::Zero(rows, columns),
      .scale_title = "squared error of health / limit of a constant engine",
      .mark_title = "its sigma is too small: covers less than 90 % of the truth",
      .bar_title = "cost of a sample, µs"};
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    matrix.columns.push_back(name_of(study.cases[c].what));
    for (std::size_t e = 0; e < study.estimators.size(); ++e) {
      const auto& score = study.cases[c].scores[e];
      if (!score) continue;
      matrix.values(as_index(e), as_index(c)) = score->ssee / study.limit;
      matrix.marked(as_index(e), as_index(c)) = score->coverage < honest_coverage ? 1 : 0;
    }
  }
  for (std::size_t e = 0; e < study.estimators.size(); ++e) matrix.bars.push_back(step_us(study, e));
  if (std::none_of(matrix.bars.begin(), matrix.bars.end(), [](double us) { return us > 0.0; })) matrix.bars.clear();
  return matrix;
}

DataTable table_of(const FamilyStudy& study) {
  DataTable table{{"case", "estimator", "held [%]", "SSEE [percent²]", "SSEE over the limit", "claims [percent²]",
                   "coverage [%]", "least coverage [%]", "bias [percent]", "half of the step seen after [s]"},
                  {}};
  for (const FamilyCaseResult& c : study.cases) {
    for (std::size_t e = 0; e < study.estimators.size(); ++e) {
      const auto& score = c.scores[e];
      if (!score) continue;
      table.rows.push_back({name_of(c.what), study.estimators[e], 100.0 * score->held, score->ssee,
                            score->ssee / study.limit, score->claims, 100.0 * score->coverage,
                            100.0 * score->least_coverage, score->bias, score->answer_s.value_or(no_number)});
    }
  }
  return table;
}

DataTable matrix_numbers(const FamilyStudy& study, const ScoreMatrix& matrix) {
  DataTable table{{"estimator"}, {}};
  for (const std::string& column : matrix.columns) table.columns.push_back(column + " [SSEE over the limit]");
  table.columns.emplace_back("cost of a sample [us]");
  for (std::size_t e = 0; e < study.estimators.size(); ++e) {
    std::vector<Cell> row{study.estimators[e]};
    for (std::size_t c = 0; c < study.cases.size(); ++c) row.emplace_back(matrix.values(as_index(e), as_index(c)));
    row.emplace_back(matrix.bars.empty() ? no_number : matrix.bars[e]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

Section family_section(const FamilyStudy& study) {
  Section section{"family", "Every estimator in every case"};
  section.add_text("Design “" + study.design_name + "”, " + counted(study.options.engines, "engine") +
                   " a case. All estimators get the same samples of the same engines. The limit of constant health "
                   "after 40 s is " +
                   quantity(study.limit, "percent²") +
                   ", that of the time-varying Kalman filter on its own model: who "
                   "flies the engine itself may be below it where health is constant, and so may a small fleet that "
                   "lies near the mean.");
  const ScoreMatrix matrix = matrix_of(study);
  section.add_figure("family-figure", "Every estimator in every case.",
                     "Blue is better than the limit, orange is worse; a black corner is a sigma that covers less than "
                     "90 % of the truth. Bars: what a sample costs, by the clock of the machine that made this page, "
                     "least of the engines; it alone is not the same in every run.",
                     responsive(matrix), matrix_numbers(study, matrix));
  section.add_table(
      "family-scores",
      "All scores. Held: share of the samples with an answer; claims: the squared error by its own sigma; "
      "coverage: health within ±1.96 sigma, 95 % is honest, least: of the parameter that is covered least; no time: "
      "half of the step was never seen",
      table_of(study));
  for (const FamilyCaseResult& c : study.cases)
    if (c.failed > 0)
      section.add_text("In case “" + name_of(c.what) + "” " + counted(c.failed, "engine") + " of " +
                       std::to_string(c.flown + c.failed) + " did not fly to the end and are in no figure.");
  if (!study.left_out.empty())
    section.add_text("Left out, since the design has not what they need: " + listed(study.left_out) + ".");
  return section;
}

}  // namespace ehm::tuner_design::report
