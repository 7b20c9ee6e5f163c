// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/kosanam/flight_batches.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/noise_source.h"

namespace ehm::tuner_design {
namespace {

constexpr double z95 = 1.959964;
constexpr std::uint64_t golden = 0x9E3779B97F4A7C15u;  ///< keeps the seeds of runs apart

/// The engine: [x; h] and what its sensors read.
class WearingEngine {
 public:
  WearingEngine(const BatchProblem& problem, double noise_factor, std::uint64_t seed)
      : problem_(problem), sensor_sigma_(std::sqrt(noise_factor) * problem.R.cwiseSqrt()), noise_(seed) {
    // Q may be singular: L sqrt(D) of L D L^T, whose pivoting is undone by the permutation
    const Eigen::LDLT<Eigen::MatrixXd> factor(problem.Q.topLeftCorner(problem.states, problem.states));
    process_root_ =
        factor.transpositionsP().transpose() *
        Eigen::MatrixXd(Eigen::MatrixXd(factor.matrixL()) * factor.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal());
  }

  void set_health(const Eigen::VectorXd& h) {
    if (state_.size() == 0) {
      const Eigen::MatrixXd A = problem_.A.topLeftCorner(problem_.states, problem_.states);
      state_.resize(problem_.A.rows());
      state_.head(problem_.states) = (Eigen::MatrixXd::Identity(A.rows(), A.cols()) - A)
                                         .partialPivLu()
                                         .solve(problem_.A.topRightCorner(problem_.states, problem_.health) * h);
    }
    state_.tail(problem_.health) = h;
  }
  Eigen::VectorXd next() {
    state_ = (problem_.A * state_).eval();
    state_.head(problem_.states) += process_root_ * normal(problem_.states);
    return problem_.C * state_ + sensor_sigma_.cwiseProduct(normal(problem_.R.size()));
  }

 private:
  Eigen::VectorXd normal(Eigen::Index size) {
    Eigen::VectorXd draws(size);
    for (double& draw : draws) draw = noise_.normal();
    return draws;
  }

  const BatchProblem& problem_;
  Eigen::MatrixXd process_root_;
  Eigen::VectorXd sensor_sigma_, state_;
  NoiseSource noise_;
};

/// Sums of one filter over the flights of one engine.
struct Sums {
  Eigen::VectorXd error, square, covered;
  Eigen::MatrixXd estimates;  ///< p x flights

  void add(const Eigen::VectorXd& miss, const Eigen::VectorXd& sigma) {
    error += miss;
    square += miss.cwiseAbs2();
    covered.array() += (miss.array().abs() <= z95 * sigma.array()).cast<double>();
  }
};

std::vector<Sums> fly_one(const BatchProblem& problem, const std::vector<FilterCase>& cases,
                          const BatchOptions& options, const WearLaw& law, std::size_t run) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.health);
  std::vector<Sums> sums(cases.size(), {zero, zero, zero, Eigen::MatrixXd(problem.health, options.flights)});
  std::vector<BatchFilter> filters;
  for (const FilterCase& one : cases) filters.emplace_back(problem, one, law.direction);
  const bool varies = std::any_of(cases.begin(), cases.end(), [](const FilterCase& c) { return !c.steady; });
  TimeVaryingGain varying(problem);
  WearingEngine engine(problem, options.noise_factor, options.seed + golden * (run + 1));
  for (int flight = 0; flight < options.flights; ++flight) {
    const Eigen::VectorXd truth = law.at(flight);
    engine.set_health(truth);
    for (int k = 0; k < options.samples; ++k) {
      const Eigen::VectorXd y = engine.next();
      if (varies) varying.step();
      for (std::size_t i = 0; i < cases.size(); ++i)
        filters[i].take(y, cases[i].steady ? *cases[i].steady : varying.now());
    }
    for (std::size_t i = 0; i < cases.size(); ++i) {
      sums[i].add(filters[i].health() - truth, filters[i].sigma());
      sums[i].estimates.col(flight) = filters[i].health();
    }
  }
  return sums;
}

}  // namespace

double BatchResult::of_change(std::size_t filter) const {
  return 100.0 * filters[filter].rms.cwiseQuotient(change).mean();
}

double BatchResult::of_change(std::size_t filter, Eigen::Index parameter) const {
  return 100.0 * filters[filter].rms(parameter) / change(parameter);
}

BatchResult fly_batches(const BatchProblem& problem, const std::vector<FilterCase>& cases, const BatchOptions& options,
                        const std::function<void(std::size_t)>& progress) {
  const WearLaw law = wear_law(problem.health_names, options.cycles_a_flight, options.equal_wear_percent);
  std::vector<std::vector<Sums>> runs(as_size(options.runs));
  long_work::parallel_for(
      runs.size(), options.threads, [&](std::size_t run) { runs[run] = fly_one(problem, cases, options, law, run); },
      progress);
  BatchResult result;
  result.change = law.at(options.flights - 1).cwiseAbs();
  result.truth.resize(problem.health, options.flights);
  for (int flight = 0; flight < options.flights; ++flight) result.truth.col(flight) = law.at(flight);
  const double count = static_cast<double>(options.runs) * options.flights;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Sums total = runs.front()[i];
    for (std::size_t run = 1; run < runs.size(); ++run) {
      total.error += runs[run][i].error;
      total.square += runs[run][i].square;
      total.covered += runs[run][i].covered;
    }
    result.filters.push_back({cases[i].name, (total.square / count).cwiseSqrt(),
                              total.error.cwiseProduct(law.direction) / count, total.covered / count, total.estimates});
  }
  return result;
}

}  // namespace ehm::tuner_design
