#include "tuner_design/sensors/sensor_set.h"

#include <Eigen/SVD>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tuner_design/choose_tuners.h"
#include "tuner_design/kalman_error.h"
#include "tuner_design/kalman_gain.h"
#include "tuner_design/observability.h"
#include "tuner_design/prepared_point.h"

namespace ehm::bench {
namespace {

std::vector<int> indices(CandidateSet set) {
  std::vector<int> result;
  for (int i = 0; i < max_candidates; ++i) {
    if ((set >> static_cast<unsigned>(i) & 1U) != 0) result.push_back(i);
  }
  return result;
}

bool within_prior(const design::SubsetDesign& filter, const estimation::LinearModel& model) {
  return (filter.health_total_covariance.diagonal().array() <= model.health_sigma.array().square()).all();
}

/// nullopt where a solver fails: the sensors tell so many tuners apart too badly.
std::optional<design::SubsetDesign> filter_with(const SensorProblem& problem, const std::vector<int>& sensors,
                                                int tuners) {
  const Eigen::MatrixXd V = closed_form_tuners(
      problem.steady.H(sensors, Eigen::all), lasting_noise(problem.model, sensors), problem.model.health_sigma, tuners);
  try {
    design::SubsetDesign filter = kalman_gain(problem.model, sensors, V, problem.qh_percent2);
    add_error_theory(filter, problem.model, problem.steady);
    return filter;
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

/// Combinations of health that these sensors see in the steady state: as many tuners as they can tell apart.
int seen_combinations(const SensorProblem& problem, const std::vector<int>& sensors) {
  if (sensors.empty()) return 0;
  const Eigen::MatrixXd Hs = problem.model.sensor_noise_sigma(sensors).cwiseInverse().asDiagonal() *
                             problem.steady.H(sensors, Eigen::all) * problem.model.health_sigma.asDiagonal();
  return seen_rank(Eigen::JacobiSVD<Eigen::MatrixXd>(Hs).singularValues());
}

}  // namespace

SensorProblem sensor_problem(const estimation::LinearModel& model, double qh_percent2,
                             const design::ErrorWeights& weights) {
  if (model.sensors.size() > static_cast<std::size_t>(max_candidates)) {
    throw std::invalid_argument("sensors: " + std::to_string(model.sensors.size()) + " candidates; allowed: at most " +
                                std::to_string(max_candidates));
  }
  SensorProblem problem;
  PreparedPoint point = prepare(model);
  problem.model = std::move(point.model);
  problem.steady = std::move(point.steady);
  problem.merit = relative_error(problem.model, problem.steady, weights);
  problem.qh_percent2 = qh_percent2;
  return problem;
}

double fleet_merit(const SensorProblem& problem) {
  const Eigen::VectorXd& sigma = problem.model.health_sigma;
  return problem.merit({sigma.cwiseAbs2(), (problem.steady.Hz * sigma.asDiagonal()).rowwise().squaredNorm()});
}

std::optional<SensorSetValue> value_of(const SensorProblem& problem, CandidateSet set) {
  const std::vector<int> sensors = indices(set);
  for (int tuners = seen_combinations(problem, sensors); tuners >= 1; --tuners) {
    const auto filter = filter_with(problem, sensors, tuners);
    if (!filter || !within_prior(*filter, problem.model)) continue;
    SensorSetValue value;
    value.tuners = tuners;
    value.error = {filter->health_total_covariance.diagonal(), filter->auxiliary_total_covariance.diagonal()};
    value.merit = problem.merit(value.error);
    value.slowest_time_constant_s = filter->slowest_time_constant_s;
    return value;
  }
  return std::nullopt;
}

}  // namespace ehm::bench
