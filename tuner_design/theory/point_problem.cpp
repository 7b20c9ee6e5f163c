// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/theory/point_problem.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/fleet_unknowns.h"
#include "tuner_design/theory/bayes_limit.h"

namespace ehm::tuner_design {
namespace {

void check_weights(const design::ErrorWeights& weights, Eigen::Index outputs) {
  if (!weights.channel.empty() && as_index(weights.channel.size()) != outputs) {
    throw std::invalid_argument("weights: " + std::to_string(weights.channel.size()) +
                                " for the auxiliary outputs; expected " + std::to_string(outputs));
  }
  const auto good = [](double weight) { return weight >= 0.0 && std::isfinite(weight); };
  bool all_good = good(weights.health) && good(weights.auxiliary);
  for (const double weight : weights.channel) all_good = all_good && good(weight);
  if (!all_good) throw std::invalid_argument("weights: allowed are finite numbers that are not negative");
  const bool outputs_count = outputs > 0 && (weights.channel.empty() ||
                                             *std::max_element(weights.channel.begin(), weights.channel.end()) > 0.0);
  if (weights.health == 0.0 && (weights.auxiliary == 0.0 || !outputs_count))
    throw std::invalid_argument("weights: all are zero, nothing is left to be good at");
}

}  // namespace

PointProblem make_point_problem(const linear_model::LinearModel& model, const estimation::SteadyGain& steady,
                                const std::vector<int>& sensors, const design::ErrorWeights& weights) {
  const Eigen::Index r = model.F.rows();
  check_weights(weights, r);
  PointProblem point;
  point.name = model.name;
  point.A = model.A;
  point.L = model.L;
  point.C = model.C(sensors, Eigen::all);
  point.M = model.M(sensors, Eigen::all);
  point.F = model.F;
  point.N = model.N;
  point.process_noise = model.process_noise;
  point.sensor_variance = model.sensor_noise_sigma(sensors).cwiseAbs2();
  point.health_covariance = model.health_sigma.cwiseAbs2().asDiagonal();
  point.H = steady.H(sensors, Eigen::all);
  point.Hz = steady.Hz;
  design::FleetUnknowns unknowns = design::fleet_unknowns(model, steady);
  unknowns.sensors = unknowns.sensors(sensors, Eigen::all).eval();
  const design::ErrorByChannel limit = steady_limit(unknowns);
  point.Gh = std::move(unknowns.health);
  point.Gy = std::move(unknowns.sensors);
  point.Gz = std::move(unknowns.auxiliary);
  point.own_readout = model.linearisation_error.size() > 0;

  constexpr double vanishes = 1e-9;  // of the prior
  Eigen::VectorXd channel = Eigen::VectorXd::Ones(r);
  std::copy(weights.channel.begin(), weights.channel.end(), channel.begin());
  const Eigen::VectorXd prior = (steady.Hz * model.health_sigma.asDiagonal()).rowwise().squaredNorm();
  const auto divisor = [&](double least, double fleet) {
    if (least > vanishes * fleet) return least;
    point.limit_is_prior = point.limit_is_prior || fleet > 0.0;
    return fleet;
  };
  point.health_limit = divisor(limit.health.sum(), point.health_covariance.trace());
  point.health_weight = weights.health / point.health_limit;
  const double auxiliary_limit = divisor(channel.dot(limit.auxiliary), channel.dot(prior));
  point.auxiliary_ratio = Eigen::VectorXd::Zero(r);
  if (auxiliary_limit > 0.0) point.auxiliary_ratio = channel / auxiliary_limit;
  point.auxiliary_weight = weights.auxiliary * point.auxiliary_ratio;
  point.lower_bound = point.health_weight * limit.health.sum() + point.auxiliary_weight.dot(limit.auxiliary);
  return point;
}

}  // namespace ehm::tuner_design
