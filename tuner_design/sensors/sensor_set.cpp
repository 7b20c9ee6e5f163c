// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/sensors/sensor_set.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/theory/prepared_point.h"

namespace ehm::tuner_design {
namespace {

std::vector<int> indices(CandidateSet set) {
  std::vector<int> result;
  for (int i = 0; i < max_candidates; ++i) {
    if ((set >> static_cast<unsigned>(i) & 1U) != 0) result.push_back(i);
  }
  return result;
}

}  // namespace

SensorProblem sensor_problem(const linear_model::LinearModel& model, double qh_percent2,
                             const design::ErrorWeights& weights) {
  if (model.sensors.size() > as_size(max_candidates)) {
    throw std::invalid_argument("sensors: " + std::to_string(model.sensors.size()) + " candidates; allowed: at most " +
                                std::to_string(max_candidates));
  }
  SensorProblem problem;
  PreparedPoint point = prepare(model);
  problem.model = std::move(point.model);
  problem.steady = std::move(point.steady);
  problem.merit = relative_error(problem.model, problem.steady, weights);
  problem.weights = weights;
  problem.qh_percent2 = qh_percent2;
  return problem;
}

double fleet_merit(const SensorProblem& problem) {
  const Eigen::VectorXd& sigma = problem.model.health_sigma;
  return problem.merit({sigma.cwiseAbs2(), (problem.steady.Hz * sigma.asDiagonal()).rowwise().squaredNorm()});
}

std::optional<SensorSetValue> value_of(const SensorProblem& problem, CandidateSet set) {
  PreparedPoint point;
  point.model = problem.model;
  point.steady = problem.steady;
  const auto filter = closed_form_filter(point, indices(set), problem.qh_percent2, problem.weights);
  if (!filter) return std::nullopt;
  SensorSetValue value;
  value.tuners = static_cast<int>(filter->V.rows());
  value.error = {filter->health_total_covariance.diagonal(), filter->auxiliary_total_covariance.diagonal()};
  value.merit = problem.merit(value.error);
  value.slowest_time_constant_s = filter->slowest_time_constant_s;
  return value;
}

}  // namespace ehm::tuner_design
