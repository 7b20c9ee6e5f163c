// Times of the engine model: a step of the transient (output and step, median, 99 % and worst over slams at three
// flight conditions), beside one evaluation of the cycle and steady solutions, cold and from a point nearby.
// Usage: engine_bench [options of Google Benchmark]. Run it on an idle machine: the worst step is what the operating
// system lets it be; the number of steps beyond 200 us is printed beside it.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "engine_sim/model/engines/jt9d.h"
#include "tests/bench/slam_flight.h"

namespace ehm::engine {
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
  std::vector<double> us;
  us.reserve(2 * SlamFlight::steps_of_all);
  for (auto _ : state) {
    flight.prepare();
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(flight.step());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    state.SetIterationTime(took.count());
    us.push_back(1e6 * took.count());
  }
  std::sort(us.begin(), us.end());
  state.counters["median_us"] = us[us.size() / 2];
  state.counters["p99_us"] = us[us.size() * 99 / 100];
  state.counters["worst_us"] = us.back();
  state.counters["beyond_200us"] = static_cast<double>(us.end() - std::upper_bound(us.begin(), us.end(), 200.0));
}
BENCHMARK(transient_step)
    ->Iterations(static_cast<benchmark::IterationCount>(SlamFlight::steps_of_all))
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
}  // namespace ehm::engine

BENCHMARK_MAIN();
