// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/studies/simon_garg.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "tuner_design/design/design_tuner.h"
#include "tuner_design/design/tuner_baselines.h"
#include "tuner_design/search/tuner_search.h"

namespace ehm::tuner_design {
namespace {

using design::Tuning;

/// Tuners of one row, and the design on them.
struct Row {
  std::string group, tuners;
  Eigen::MatrixXd V;
};

/// One end of a search that starts at random, for health alone or for the auxiliary outputs alone.
Eigen::MatrixXd searched(const PreparedPoint& point, const design::ErrorWeights& weights, std::uint64_t seed) {
  SearchProblem problem;
  problem.estimator = Estimator::map;
  problem.points.push_back({make_point_problem(point.model, point.steady, all_sensors(point.model), weights), 1.0});
  SearchOptions options;
  options.starts = random_tuners(point.model.C.rows(), point.model.L.cols(), 1, seed);
  options.random_starts = 0;
  return search_tuners(problem, options).V;
}

std::vector<Row> rows_of(const PreparedPoint& point, const SimonGargOptions& options) {
  std::vector<Row> rows;
  const bool kalman = options.table >= 6;
  const auto subset = published_subset(point.model);
  if (kalman && subset.size() == point.model.sensors.size())
    rows.push_back({"subset of " + std::to_string(subset.size()), "", subset_tuners(point.model, subset)});
  for (int i = 0; i < 8; ++i) {
    const bool health = i < 4;
    const design::ErrorWeights weights{health ? 1.0 : 0.0, health ? 0.0 : 1.0, {}};
    rows.push_back({health ? "least MAP error of h" : "least MAP error of z",
                    std::string(1, static_cast<char>('a' + i)),
                    searched(point, weights, options.seed + static_cast<std::uint64_t>(i))});
  }
  const Envelope envelope{{point}, {1.0}};
  design::DesignOptions design;
  design.qh_percent2 = options.qh_percent2;
  design.tuning = Tuning::closed_form;
  rows.push_back({"closed form H Ph", "", full_set_tuners(envelope, design)});
  if (kalman) {
    design.tuning = Tuning::kalman;
    rows.push_back({"least Kalman error of h and z", "", full_set_tuners(envelope, design)});
  }
  return rows;
}

StudyRow row_of(const Row& row, const Experiment& experiment) {
  return {row.group, row.tuners, experiment.theory, experiment.experiment, experiment.standard_error};
}

}  // namespace

SimonGargStudy run_simon_garg(const linear_model::LinearModel& model, const SimonGargOptions& options,
                              const EvaluateProgress& progress) {
  if (options.table < 4 || options.table > 7)
    throw std::invalid_argument("study: table " + std::to_string(options.table) + "; allowed are 4, 5, 6, 7");
  if (model.sensors.size() >= model.health.size())
    throw std::invalid_argument("study: " + std::to_string(model.sensors.size()) + " sensors for " +
                                std::to_string(model.health.size()) +
                                " health parameters; nothing has to be reduced, there is nothing to study");
  if (model.auxiliary.empty())
    throw std::invalid_argument("study: the model has no auxiliary outputs; rows e to h are searched for them");

  SimonGargStudy study;
  study.model = model;
  study.model.linearisation_error.resize(0, 0);  // the paper's truth is linear
  study.options = options;
  const PreparedPoint point = prepare(study.model);
  study.scaling = point.scaling;
  const std::vector<Row> rows = rows_of(point, options);
  EvaluateOptions evaluation;
  evaluation.kalman = options.table >= 6;
  evaluation.map = !evaluation.kalman;
  evaluation.engines = options.engines;
  evaluation.runs = options.runs;
  evaluation.seed = options.seed;
  evaluation.threads = options.threads;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const design::Design design = design_on_tuners(study.model, rows[i].V, options.qh_percent2);
    const Evaluation result = evaluate(design, evaluation, [&](double share) {
      progress((static_cast<double>(i) + share) / static_cast<double>(rows.size()));
    });
    study.truth = result.experiments.front().truth;
    if (evaluation.map && i == 0)
      study.rows.push_back(row_of({"10 health parameters", "", {}}, result.experiments.front()));
    study.rows.push_back(row_of(rows[i], result.experiments.back()));
    if (i + 1 == rows.size()) study.rows.push_back({"Bayes limit, endless averaging", "", design.bayes_limit, {}, {}});
  }
  return study;
}

}  // namespace ehm::tuner_design
