// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/kosanam/batch_problem.h"

#include <stdexcept>
#include <utility>

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/estimation/capacity.h"
#include "monitor/estimation/linear/riccati.h"
#include "tuner_design/theory/prepared_point.h"

namespace ehm::tuner_design {
namespace {

constexpr double start_sigma = 1e-4;

void require(bool good, const linear_model::LinearModel& model) {
  if (good) return;
  throw std::invalid_argument("has " + std::to_string(model.sensors.size()) + " sensors and " +
                              std::to_string(model.health.size()) +
                              " health parameters; this study needs as many sensors as health parameters or more, and "
                              "at most " +
                              std::to_string(estimation::max_health) + " of those");
}

}  // namespace

BatchProblem batch_problem(const linear_model::LinearModel& model, double health_variance) {
  require(model.sensors.size() >= model.health.size() && model.health.size() <= estimation::max_health, model);
  const PreparedPoint point = prepare(model);
  const linear_model::LinearModel& scaled = point.model;
  BatchProblem p;
  p.model = model.name;
  p.health_names = names_of(model.health);
  p.sample_time_s = scaled.sample_time_s;
  p.states = scaled.A.rows();
  p.health = scaled.L.cols();
  const Eigen::Index n = p.states, all = n + p.health;
  p.A.setIdentity(all, all);
  p.A.topLeftCorner(n, n) = scaled.A;
  p.A.topRightCorner(n, p.health) = scaled.L;
  p.C.resize(scaled.C.rows(), all);
  p.C << scaled.C, scaled.M;
  p.Q.setZero(all, all);
  p.Q.topLeftCorner(n, n) = scaled.process_noise;
  p.R = scaled.sensor_noise_sigma.cwiseAbs2();
  Eigen::VectorXd start(all);
  start << start_sigma * point.scaling.state.cwiseInverse(), start_sigma * point.scaling.health.cwiseInverse();
  p.P0 = start.cwiseAbs2().asDiagonal();
  return with_health_variance(std::move(p), health_variance);
}

BatchProblem with_health_variance(BatchProblem problem, double health_variance) {
  problem.Q.diagonal().tail(problem.health).setConstant(health_variance);
  return problem;
}

SteadyFilter steady_filter(const BatchProblem& problem) {
  const Eigen::MatrixXd R = problem.R.asDiagonal();
  const Eigen::MatrixXd P = estimation::solve_filter_riccati(problem.A, problem.C, problem.Q, R);
  const Eigen::MatrixXd CP = problem.C * P;
  SteadyFilter filter;
  filter.K = (CP * problem.C.transpose() + R).llt().solve(CP).transpose();
  filter.P = P - filter.K * CP;
  filter.P = 0.5 * (filter.P + filter.P.transpose()).eval();
  return filter;
}

}  // namespace ehm::tuner_design
