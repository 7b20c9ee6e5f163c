// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/kosanam/gain_search.h"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>

#include "deploy/runtime/numbers/noise_source.h"
#include "tuner_design/robust/robust_gain.h"

namespace ehm::tuner_design {
namespace {

constexpr double sample_s = 0.1, position_sigma_ft = 10.0, acceleration_sigma_ft_s2 = 0.2, acceleration_ft_s2 = 1.0;
constexpr double least_variance = 0.1, unstable_ft = 1e6;
const std::vector<double> least_decades{-4.0, -5.0}, greatest_decades{0.0, 0.7};
constexpr std::uint64_t test_stream = 0x9E3779B97F4A7C15u;

const Eigen::Matrix2d motion = (Eigen::Matrix2d() << 1.0, sample_s, 0.0, 1.0).finished();
const Eigen::Vector2d push(0.5 * sample_s * sample_s, sample_s);

/// How the vehicles of a study differ from the model.
struct Spread {
  double noise, answer;
};

/// Mean of squared position errors of one vehicle.
double flown(const Eigen::Vector2d& K, const Spread& spread, int samples, std::uint64_t seed) {
  NoiseSource random(seed);
  const double alpha = random.normal(), beta = random.normal(), gamma = random.normal();
  const double push_sigma = acceleration_sigma_ft_s2 * std::sqrt(std::max(least_variance, 1.0 + spread.noise * alpha));
  const double read_sigma = position_sigma_ft * std::sqrt(std::max(least_variance, 1.0 + spread.noise * beta));
  Eigen::Vector2d truth(0.0, 0.0), estimate(0.0, 0.0);
  double sum = 0.0;
  for (int k = 0; k < samples; ++k) {
    const double answer = (1.0 + spread.answer * gamma) * acceleration_ft_s2;
    truth = motion * truth + push * (answer + push_sigma * random.normal());
    estimate = motion * estimate + push * acceleration_ft_s2;
    estimate += K * (truth(0) + read_sigma * random.normal() - estimate(0));
    sum += (truth(0) - estimate(0)) * (truth(0) - estimate(0));
  }
  return sum / samples;
}

/// Root mean square over runs of one stream.
double error_of(const Eigen::Vector2d& K, const Spread& spread, int runs, int samples, std::uint64_t stream) {
  double sum = 0.0;
  for (int run = 0; run < runs; ++run) sum += flown(K, spread, samples, stream + static_cast<std::uint64_t>(run));
  const double error = std::sqrt(sum / runs);
  return error < unstable_ft ? error : unstable_ft;
}

/// What the search is about: the gain's elements in decades, since they differ by one or two of them.
struct Trial {
  Spread spread;
  const GainSearchOptions& options;
  Eigen::Vector2d best{0.1, 0.1};
  double least_ft = unstable_ft;
};

double tried(const std::vector<double>& decades, std::vector<double>&, void* data) {
  Trial& trial = *static_cast<Trial*>(data);
  const GainSearchOptions& o = trial.options;
  const Eigen::Vector2d K(std::pow(10.0, decades[0]), std::pow(10.0, decades[1]));
  const double error_ft = error_of(K, trial.spread, o.training_runs, o.samples, o.seed);
  if (error_ft < trial.least_ft) {
    trial.least_ft = error_ft;
    trial.best = K;
  }
  return error_ft;
}

Eigen::Vector2d searched(const Spread& spread, const GainSearchOptions& options) {
  nlopt::srand(static_cast<unsigned long>(options.seed));
  nlopt::opt search(nlopt::GN_ESCH, 2);
  search.set_lower_bounds(least_decades);
  search.set_upper_bounds(greatest_decades);
  search.set_maxeval(options.evaluations);
  Trial trial{spread, options};
  search.set_min_objective(tried, &trial);
  std::vector<double> start{-1.0, -1.0};
  double error_ft = 0.0;
  search.optimize(start, error_ft);
  return trial.best;
}

RobustProblem vehicle() {
  RobustProblem problem;
  problem.A = motion;
  problem.C = Eigen::RowVector2d(1.0, 0.0);
  problem.Q = acceleration_sigma_ft_s2 * acceleration_sigma_ft_s2 * push * push.transpose();
  problem.W = Eigen::Vector2d(1.0, 0.0).asDiagonal();
  problem.R = Eigen::VectorXd::Constant(1, position_sigma_ft * position_sigma_ft);
  return problem;
}

}  // namespace

GainSearch search_gains(const GainSearchOptions& options) {
  GainSearch study;
  study.options = options;
  const RobustProblem problem = vehicle();
  const Eigen::Vector2d standard = kalman_gain_for(problem, Eigen::VectorXd::Ones(1));
  const Eigen::Vector2d robust = robust_gain(problem, {1.0, 1.0, options.spread, options.spread}).K;
  const std::uint64_t test = options.seed + test_stream;
  const auto add = [&](const std::string& name, const Spread& spread, double published_robust,
                       double published_searched) {
    GainSearchRow row{name, {}, published_robust, published_searched};
    row.gains = {{{"Kalman", standard}, {"robust", robust}, {"searched", searched(spread, options)}}};
    for (SearchedGain& gain : row.gains)
      gain.error_ft = error_of(gain.K, spread, options.test_runs, options.samples, test);
    study.rows.push_back(row);
  };
  add("noise", {options.spread, 0.0}, 0.25, 0.83);
  add("model", {0.0, options.answer_spread}, 0.0, 0.86);
  return study;
}

}  // namespace ehm::tuner_design
