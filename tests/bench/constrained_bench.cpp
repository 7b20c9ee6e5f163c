// SPDX-License-Identifier: Apache-2.0
// What a sample costs a filter of Kosanam's study (MAPSS: 3 states, 8 health parameters, 11 sensors), to be read beside
// figure 5.1 (steady 60 % cheaper than time-varying) and section 5.2 (constrained four times the steady one): steady,
// time-varying, and steady with each constraint, whose bound is at work as in the study.

#include <benchmark/benchmark.h>

#include <cmath>
#include <optional>
#include <vector>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/noise_source.h"
#include "tuner_design/kosanam/batch_filter.h"
#include "tuner_design/kosanam/mapss_model.h"
#include "tuner_design/wear/wear_law.h"

namespace {

using namespace ehm;
using namespace ehm::tuner_design;

constexpr int samples = 15000, samples_a_flight = 30;
constexpr double health_variance = 75e-6;  ///< where the plain filter errs least

const BatchProblem& problem() {
  static const BatchProblem mapss = batch_problem(mapss_model(), health_variance);
  return mapss;
}

/// Of an engine in balance with its wear.
const std::vector<Eigen::VectorXd>& readings() {
  static const std::vector<Eigen::VectorXd> all = [] {
    const BatchProblem& p = problem();
    const WearLaw law = wear_law(p.health_names, 12.0);
    const Eigen::Index n = p.states;
    const Eigen::MatrixXd balance =
        (Eigen::MatrixXd::Identity(n, n) - p.A.topLeftCorner(n, n)).inverse() * p.A.topRightCorner(n, p.health);
    NoiseSource random(1);
    std::vector<Eigen::VectorXd> y;
    for (int k = 0; k < samples; ++k) {
      Eigen::VectorXd state(p.A.rows());
      const Eigen::VectorXd h = law.at(static_cast<double>(k) / samples_a_flight);
      state << balance * h, h;
      y.emplace_back(p.C * state);
      for (Eigen::Index i = 0; i < p.R.size(); ++i) y.back()(i) += std::sqrt(p.R(i)) * random.normal();
    }
    return y;
  }();
  return all;
}

void filter(benchmark::State& state, const FilterCase& what) {
  const WearLaw law = wear_law(problem().health_names, 12.0);
  const auto& y = readings();
  for (auto _ : state) {
    BatchFilter one(problem(), what, law.direction);
    TimeVaryingGain varying(problem());
    for (const Eigen::VectorXd& reading : y) {
      if (!what.steady) varying.step();
      one.take(reading, what.steady ? *what.steady : varying.now());
    }
    benchmark::DoNotOptimize(one.health().data());
  }
  state.SetItemsProcessed(state.iterations() * samples);
  state.counters["sample"] =
      benchmark::Counter(samples, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(filter, steady, FilterCase{"", steady_filter(problem())});
BENCHMARK_CAPTURE(filter, time_varying, FilterCase{"", std::nullopt});
BENCHMARK_CAPTURE(filter, identity, FilterCase{"", steady_filter(problem()), BatchWay::identity});
BENCHMARK_CAPTURE(filter, projection, FilterCase{"", steady_filter(problem()), BatchWay::projection});
BENCHMARK_CAPTURE(filter, projection_2_sigma_behind,
                  FilterCase{"", steady_filter(problem()), BatchWay::projection, false, 2.0});
BENCHMARK_CAPTURE(filter, truncation_3_sigma_behind,
                  FilterCase{"", steady_filter(problem()), BatchWay::truncation, false, 3.0});

}  // namespace

BENCHMARK_MAIN();
