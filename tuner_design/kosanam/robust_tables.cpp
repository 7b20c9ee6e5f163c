// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/kosanam/robust_tables.h"

#include <algorithm>
#include <stdexcept>

#include "tuner_design/robust/robust_gain.h"

namespace ehm::tuner_design {
namespace {

RobustProblem robust_problem(const BatchProblem& problem) {
  RobustProblem robust;
  robust.A = problem.A;
  robust.C = problem.C;
  robust.Q = problem.Q;
  robust.R = problem.R;
  robust.W.setZero(problem.A.rows(), problem.A.cols());
  robust.W.diagonal().tail(problem.health).setOnes();
  return robust;
}

/// Of qh, where the steady Kalman filter errs least.
double best_factor(const BatchProblem& nominal, const RobustTablesOptions& options) {
  double best = 1.0, least = -1.0;
  for (const double factor : options.sweep) {
    const BatchProblem problem = with_health_variance(nominal, factor * options.health_variance);
    const double error = fly_batches(problem, {{"", steady_filter(problem)}}, options.batch).mean_rms(0);
    if (least >= 0.0 && error >= least) continue;
    least = error;
    best = factor;
  }
  return best;
}

}  // namespace

const BatchResult& RobustTables::at(double noise_factor) const {
  const auto& factors = options.noise_factors;
  const auto at = std::find(factors.begin(), factors.end(), noise_factor);
  if (at == factors.end()) throw std::out_of_range("no table of that noise");
  return by_noise[static_cast<std::size_t>(at - factors.begin())];
}

RobustTables robust_tables(const linear_model::LinearModel& model, const RobustTablesOptions& options) {
  RobustTables tables;
  tables.options = options;
  BatchOptions batch = options.batch;
  batch.cycles_a_flight = whole_life_cycles / batch.flights;
  tables.options.batch = batch;
  const BatchProblem nominal = batch_problem(model, options.health_variance);
  tables.model = nominal.model;
  for (const linear_model::Channel& parameter : model.health) tables.health.push_back(parameter.name);
  tables.not_known = wear_law(model.health, batch.cycles_a_flight).not_known;
  tables.factor = best_factor(nominal, tables.options);
  const BatchProblem problem = with_health_variance(nominal, tables.factor * options.health_variance);

  const RobustProblem robust = robust_problem(problem);
  const RobustWeights weights{1.0, options.rho2, 0.0, 1.0};
  const SteadyFilter standard = steady_filter(problem);
  const RobustGain gain = robust_gain(robust, weights);
  tables.mu = gain.mu(0);
  tables.robust_objective = gain.objective;
  tables.standard_objective = robust_objective(robust, weights, standard.K);
  // the covariance stays the standard one's: nothing here asks for it
  const std::vector<FilterCase> cases{
      {"standard", standard},
      {"mixed", SteadyFilter{options.eta * standard.K + (1.0 - options.eta) * gain.K, standard.P}},
      {"robust", SteadyFilter{gain.K, standard.P}}};
  for (const double factor : options.noise_factors) {
    batch.noise_factor = factor;
    tables.by_noise.push_back(fly_batches(problem, cases, batch));
  }
  return tables;
}

}  // namespace ehm::tuner_design
