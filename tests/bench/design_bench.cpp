// SPDX-License-Identifier: Apache-2.0
// What a design costs, at 7 sensors and 10 health parameters (our engine at cruise, tangent model):
//   one objective with its adjoint gradient, the same gradient by central differences over the entries of V*, their
//   ratio in this run, and a whole design from 10 starts with its designs for a missing sensor, on one thread.
// And of a seeded stable model of 24 states and 12 sensors: a robust gain, its relative gradient, and the curve of its
// trades in 100 points.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "deploy/runtime/numbers/noise_source.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/linearise/linearise.h"
#include "tuner_design/robust/robust_gain.h"
#include "tuner_design/search/kalman_objective.h"
#include "tuner_design/search/row_space.h"

namespace {

using namespace ehm;
using namespace ehm::tuner_design;

constexpr double qh_percent2 = 1e-3;

struct Cruise {
  Cruise() {
    LineariseOptions options;
    options.flight = {10668.0, 0.8, 0.0};
    options.demand = {engine_sim::DemandKind::t40_k, cruise_t40_k};
    options.fleet = 0;
    model = linearise(engine_sim::default_engine(), options).model;
    const PreparedPoint prepared = prepare(model);
    point = make_point_problem(prepared.model, prepared.steady, all_sensors(model), {});
    V = row_space(point.H * point.health_covariance);
  }
  linear_model::LinearModel model;
  PointProblem point;
  Eigen::MatrixXd V;
};

const Cruise& cruise() {
  static const Cruise value;
  return value;
}

const RobustProblem& seeded_24_by_12() {
  static const RobustProblem problem = [] {
    NoiseSource random{1};
    const auto normal = [&](Eigen::Index rows, Eigen::Index cols) {
      return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return random.normal(); }).eval();
    };
    const Eigen::MatrixXd root = normal(24, 24);
    RobustProblem p{normal(24, 24), normal(12, 24), 0.01 * root * root.transpose(), Eigen::MatrixXd::Identity(24, 24),
                    Eigen::VectorXd::Ones(12)};
    p.A *= 0.97 / estimation::spectral_radius(p.A);
    return p;
  }();
  return problem;
}

void Robust(benchmark::State& state) {
  RobustGain gain;
  for (auto _ : state) gain = robust_gain(seeded_24_by_12(), {1.0, 1.0, 0.3, 1.0});
  state.counters["relative_gradient"] = gain.relative_gradient;
  state.counters["riccati_equations"] = gain.riccati_equations;
}
BENCHMARK(Robust)->Unit(benchmark::kMillisecond);

void RobustTradeOf100Points(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(robust_trade(seeded_24_by_12(), 0.01, 1e4, 100));
}
BENCHMARK(RobustTradeOf100Points)->Unit(benchmark::kMillisecond);

double central_differences(Eigen::MatrixXd& gradient) {
  constexpr double step = 1e-6;
  Eigen::MatrixXd moved = cruise().V;
  gradient.resize(moved.rows(), moved.cols());
  for (Eigen::Index i = 0; i < moved.size(); ++i) {
    const double entry = moved(i);
    moved(i) = entry + step;
    const double up = *kalman_objective(cruise().point, row_space(moved), qh_percent2);
    moved(i) = entry - step;
    gradient(i) = (up - *kalman_objective(cruise().point, row_space(moved), qh_percent2)) / (2.0 * step);
    moved(i) = entry;
  }
  return gradient.norm();
}

void Objective(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(kalman_objective(cruise().point, cruise().V, qh_percent2));
}
BENCHMARK(Objective)->Unit(benchmark::kMicrosecond);

void ObjectiveWithGradient(benchmark::State& state) {
  Eigen::MatrixXd gradient;
  for (auto _ : state) benchmark::DoNotOptimize(kalman_objective(cruise().point, cruise().V, qh_percent2, &gradient));
}
BENCHMARK(ObjectiveWithGradient)->Unit(benchmark::kMicrosecond);

void GradientByCentralDifferences(benchmark::State& state) {
  Eigen::MatrixXd gradient;
  for (auto _ : state) benchmark::DoNotOptimize(central_differences(gradient));
}
BENCHMARK(GradientByCentralDifferences)->Unit(benchmark::kMicrosecond);

void DesignFromTenStarts(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(design_tuner(cruise().model, {}, 1));
}
BENCHMARK(DesignFromTenStarts)->Unit(benchmark::kMillisecond);

template <typename Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Least of many rounds each, alternating, so that an interruption of the machine spoils neither.
void print_ratio() {
  constexpr int rounds = 200;
  double adjoint_s = 1.0, differences_s = 1.0;
  Eigen::MatrixXd adjoint, differences;
  for (int i = 0; i < rounds; ++i) {
    adjoint_s =
        std::min(adjoint_s, seconds([&] {
                   benchmark::DoNotOptimize(kalman_objective(cruise().point, cruise().V, qh_percent2, &adjoint));
                 }));
    differences_s = std::min(differences_s, seconds([&] { central_differences(differences); }));
  }
  std::printf("gradient by central differences / adjoint: %.0f times the time (%.0f and %.1f us, least of %d)\n",
              differences_s / adjoint_s, 1e6 * differences_s, 1e6 * adjoint_s, rounds);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  print_ratio();
  return 0;
}
