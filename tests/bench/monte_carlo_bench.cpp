// SPDX-License-Identifier: Apache-2.0
// Speed of Monte Carlo on the linear truth, at the size of the JT9D-class engine: 2 states, 7 sensors, 10 health
// parameters, 7 tuners, 5 actuators, 4 auxiliary outputs.
//   kalman_steps           15 ms steps a second on one core: truth, noise, filter and the errors of the window
//   filter_step            the monitor's filter alone: predict, innovation, update with all its outputs
//   fused_fixed_size       the least that such a filter can cost: xhat = Acl xhat + (I-KC) B u + K y,
//                          sizes known to the compiler, no innovation, no outputs,
//                          no choice of sensors
//   fused_with_outputs     the same with h and z
//   filter_step_ratio      all three in one run, alternating; ratios of filter_step to the other two
//   sensor_noise           seven normal deviates
// Usage: monte_carlo_bench [options of Google Benchmark]. Times are of the CPU; the least of the repetitions counts on
// a machine that does other work too.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>

#include "engine_sim/engines/jt9d_engine.h"
#include "monitor/design/make_filter.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/linearise/linearise.h"
#include "tuner_design/monte_carlo/kalman_experiment.h"
#include "tuner_design/monte_carlo/random_stream.h"

namespace ehm::tuner_design {
namespace {

constexpr int states = 9, sensors = 7, actuators = 5, health = 10, auxiliary = 4;  // states: two and seven tuners

/// Sizes that the design has not would read beyond its matrices.
design::Design sized(design::Design design) {
  const linear_model::LinearModel& model = design.model;
  if (design.full.A.rows() != states || model.sensors.size() != sensors || model.controls.size() != actuators ||
      model.health.size() != health || model.auxiliary.size() != auxiliary)
    throw std::logic_error("monte_carlo_bench: the default engine's design has other sizes than the bench");
  return design;
}

/// Cruise by the tangent, which has all seven tuners.
const design::Design& cruise_design() {
  static const design::Design design = [] {
    LineariseOptions options;
    options.flight = {10668.0, 0.8, 0.0};
    options.demand = {engine_sim::DemandKind::t40_k, 1308.6};
    options.fleet = 0;
    return sized(design_tuner(linearise(engine_sim::default_engine(), options).model, {}));
  }();
  return design;
}

void kalman_steps(benchmark::State& state) {
  const Truth truth = linear_truth(cruise_design());
  KalmanOptions options;
  options.window = window_of(30.0, 10.0, 0.015);
  options.process_noise = state.range(0) != 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(kalman_experiment(cruise_design(), truth, options, [](std::size_t) {}));
    ++options.seed;
  }
  const auto steps = static_cast<double>(options.runs) * options.window.samples;
  state.counters["steps_per_s"] = benchmark::Counter(steps, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(kalman_steps)->ArgName("process_noise")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

class FilterStep {
 public:
  void operator()() {
    benchmark::DoNotOptimize(y_.data());
    filter_.predict(u_);
    filter_.innovation(y_, u_);
    filter_.update(all_);
    benchmark::DoNotOptimize(filter_.health().data());
    benchmark::ClobberMemory();
  }

 private:
  estimation::TunerFilter filter_ = design::make_filter(cruise_design());
  estimation::SensorVector y_ = estimation::SensorVector::Ones(sensors);
  estimation::ActuatorVector u_ = estimation::ActuatorVector::Zero(actuators);
  estimation::SensorMask all_{(1u << sensors) - 1u};
};

/// `outputs`: h and z as well.
template <bool outputs>
class FusedFixedSize {
 public:
  FusedFixedSize() {
    const estimation::TunerFilter filter = design::make_filter(cruise_design());
    const estimation::SubsetGain& gain = filter.gain();
    Acl_ = gain.A - gain.K * gain.C * gain.A;
    B_ = gain.B - gain.K * gain.C * gain.B;
    K_ = gain.K;
    Th_ = gain.health_output, Tz_ = gain.auxiliary_output, G_ = filter.model().G;
    x_.setZero(), y_.setOnes(), u_.setZero();
  }
  void operator()() {
    benchmark::DoNotOptimize(y_.data());
    next_.noalias() = Acl_ * x_;
    next_.noalias() += K_ * y_;
    next_.noalias() += B_ * u_;
    x_ = next_;
    if constexpr (outputs) {
      h_.noalias() = Th_ * x_;
      z_.noalias() = Tz_ * x_;
      z_.noalias() += G_ * u_;
    }
    benchmark::DoNotOptimize(x_.data());
    benchmark::ClobberMemory();
  }

 private:
  Eigen::Matrix<double, states, states> Acl_;
  Eigen::Matrix<double, states, actuators> B_;
  Eigen::Matrix<double, states, sensors> K_;
  Eigen::Matrix<double, health, states> Th_;
  Eigen::Matrix<double, auxiliary, states> Tz_;
  Eigen::Matrix<double, auxiliary, actuators> G_;
  Eigen::Matrix<double, states, 1> x_, next_;
  Eigen::Matrix<double, sensors, 1> y_;
  Eigen::Matrix<double, actuators, 1> u_;
  Eigen::Matrix<double, health, 1> h_;
  Eigen::Matrix<double, auxiliary, 1> z_;
};

template <class Step>
void repeated(benchmark::State& state) {
  Step step;
  for (auto _ : state) step();
}
BENCHMARK(repeated<FilterStep>)->Name("filter_step");
BENCHMARK(repeated<FusedFixedSize<false>>)->Name("fused_fixed_size");
BENCHMARK(repeated<FusedFixedSize<true>>)->Name("fused_with_outputs");

template <class Step>
double nanoseconds_each(Step& step) {
  constexpr int steps = 2000;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < steps; ++i) step();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / steps;
}

/// Least times of short stretches that alternate: what else the machine does hits all or none.
void filter_step_ratio(benchmark::State& state) {
  FilterStep filter;
  FusedFixedSize<false> fused;
  FusedFixedSize<true> fused_outputs;
  double filter_ns = std::numeric_limits<double>::infinity(), fused_ns = filter_ns, fused_outputs_ns = filter_ns;
  for (auto _ : state) {
    filter_ns = std::min(filter_ns, nanoseconds_each(filter));
    fused_ns = std::min(fused_ns, nanoseconds_each(fused));
    fused_outputs_ns = std::min(fused_outputs_ns, nanoseconds_each(fused_outputs));
  }
  state.counters["filter_ns"] = filter_ns;
  state.counters["fused_ns"] = fused_ns;
  state.counters["with_outputs_ns"] = fused_outputs_ns;
  state.counters["ratio"] = filter_ns / fused_ns;
  state.counters["ratio_with_outputs"] = filter_ns / fused_outputs_ns;
}
BENCHMARK(filter_step_ratio)->Iterations(1000)->Unit(benchmark::kMicrosecond);

void sensor_noise(benchmark::State& state) {
  RandomStream random(1, 0);
  Eigen::Matrix<double, sensors, 1> noise;
  for (auto _ : state) {
    for (double& each : noise) each = random.normal();
    benchmark::DoNotOptimize(noise.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(sensor_noise);

}  // namespace
}  // namespace ehm::tuner_design

BENCHMARK_MAIN();
