// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/kosanam/robust_tables.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/linear/solver_error.h"

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

constexpr double farthest_mu = 300.0;
constexpr int trade_points = 60, surface_points = 11;
constexpr double least_share = -1.0, most_share = 3.0;

/// Of the health parameter whose row of the gain is the largest, by the two sensors that it uses most.
ObjectiveSurface surface_of(const RobustProblem& problem, const RobustWeights& weights, const Eigen::MatrixXd& K,
                            Eigen::Index states) {
  ObjectiveSurface surface;
  K.bottomRows(K.rows() - states).rowwise().norm().maxCoeff(&surface.parameter);
  const Eigen::Index row = states + surface.parameter;
  Eigen::RowVectorXd sizes = K.row(row).cwiseAbs();
  sizes.maxCoeff(&surface.first);
  sizes(surface.first) = -1.0;
  sizes.maxCoeff(&surface.second);
  for (int i = 0; i < surface_points; ++i)
    surface.share.push_back(least_share + (most_share - least_share) * i / (surface_points - 1));
  const double standard = robust_objective(problem, weights, K);
  surface.objective.resize(surface_points, surface_points);
  for (int i = 0; i < surface_points; ++i) {
    for (int j = 0; j < surface_points; ++j) {
      Eigen::MatrixXd tried = K;
      tried(row, surface.first) *= surface.share[as_size(i)];
      tried(row, surface.second) *= surface.share[as_size(j)];
      try {
        surface.objective(i, j) = robust_objective(problem, weights, tried) / standard;
      } catch (const estimation::SolverError&) {
        surface.objective(i, j) = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  return surface;
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
  tables.health = names_of(model.health);
  tables.not_known = wear_law(tables.health, batch.cycles_a_flight).not_known;
  tables.factor = best_factor(nominal, tables.options);
  const BatchProblem problem = with_health_variance(nominal, tables.factor * options.health_variance);

  const RobustProblem robust = robust_problem(problem);
  const RobustWeights weights{1.0, options.rho2, 0.0, 1.0};
  const SteadyFilter standard = steady_filter(problem);
  const RobustGain gain = robust_gain(robust, weights);
  tables.mu = gain.mu(0);
  tables.robust_objective = gain.objective;
  tables.standard_objective = robust_objective(robust, weights, standard.K);
  tables.trade = robust_trade(robust, 1.0, std::max(farthest_mu, 2.0 * tables.mu), trade_points);
  tables.surface = surface_of(robust, weights, standard.K, problem.states);
  tables.sensors = names_of(model.sensors);
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
