// SPDX-License-Identifier: Apache-2.0
// Times of the engine model: a step of the transient (output and step, median, 99 % and worst over slams at three
// flight conditions), beside one evaluation of the cycle and steady solutions, cold and from a point nearby.
// Usage: engine_bench [options of Google Benchmark]. The flight is flown five times and does the same work each time,
// so the least of a step's five times is free of what the operating system interposed: worst_us and median_us are over
// these least times, interrupted_us is the worst of all times and beyond_200us how many there were.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <vector>

#include "engine_sim/engines/jt9d.h"
#include "tests/bench/slam_flight.h"

namespace ehm::engine_sim {
namespace {

const Turbofan& turbofan() {
  static const Turbofan engine(jt9d());
  return engine;
}

SteadyPoint cruise_point() {
  return solve_steady(turbofan(), high_cruise, {}, {DemandKind::limit_ratio, 0.9});
}

void transient_step(benchmark::State& state) {
  SlamFlight flight(turbofan());
  std::vector<double> us(SlamFlight::steps_of_all, std::numeric_limits<double>::infinity());
  std::size_t k = 0;
  double interrupted_us = 0.0, beyond_200us = 0.0;
  for (auto _ : state) {
    flight.prepare();
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(flight.step());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    state.SetIterationTime(took.count());
    const double step_us = 1e6 * took.count();
    double& least_us = us[k++ % us.size()];
    least_us = std::min(least_us, step_us);
    interrupted_us = std::max(interrupted_us, step_us);
    beyond_200us += step_us > 200.0 ? 1.0 : 0.0;
  }
  std::sort(us.begin(), us.end());
  state.counters["median_us"] = us[us.size() / 2];
  state.counters["p99_us"] = us[us.size() * 99 / 100];
  state.counters["worst_us"] = us.back();
  state.counters["interrupted_us"] = interrupted_us;
  state.counters["beyond_200us"] = beyond_200us;
}
BENCHMARK(transient_step)
    ->Iterations(static_cast<benchmark::IterationCount>(5 * SlamFlight::steps_of_all))
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

template <class S>
void cycle_evaluation(benchmark::State& state) {
  const SteadyPoint at = cruise_point();
  const Intake in = intake(turbofan().data().inlet, high_cruise);
  const auto x = pack(at.unknowns);
  CycleInput<S> input{
      at.gas.speeds.n1_rpm, at.gas.speeds.n2_rpm, at.gas.fuel_flow_kg_s, {x[0], x[1], x[2], x[3], x[4], x[5]}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(input);
    benchmark::DoNotOptimize(turbofan().cycle(in, at.operation, input).flow_residual);
  }
}
BENCHMARK(cycle_evaluation<double>)->Unit(benchmark::kMicrosecond);
BENCHMARK(cycle_evaluation<Dual<6>>)->Unit(benchmark::kMicrosecond);
BENCHMARK(cycle_evaluation<Dual<9>>)->Unit(benchmark::kMicrosecond);

void steady_cold(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(cruise_point());
}
BENCHMARK(steady_cold)->Unit(benchmark::kMicrosecond);

/// Rows as of a performance deck: random flights and fuel flows around cruise, each from the row before.
void steady_warm(benchmark::State& state) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> altitude_m(8000.0, 12000.0), mach(0.6, 0.85), share(0.7, 1.0);
  SteadyPoint last = cruise_point();
  for (auto _ : state) {
    const FlightCondition flight{altitude_m(random), mach(random), 0.0};
    last = solve_steady(turbofan(), flight, {}, {DemandKind::limit_ratio, share(random)}, &last);
  }
}
BENCHMARK(steady_warm)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ehm::engine_sim

BENCHMARK_MAIN();
