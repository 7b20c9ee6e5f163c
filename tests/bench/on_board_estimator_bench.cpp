// SPDX-License-Identifier: Apache-2.0
// Time of the on-board estimator, and with a design of tuner_design envelope of the scheduled one, for one sample
// (predict, innovate, update), over taxi, take-off and the first part of the climb of a perturbed engine at 15 ms,
// beside the simulator's own step for the same sample; and of the nonlinear filters on the same engine.
// Usage: on_board_estimator_bench [REPETITIONS [DESIGN]]     (default 5)
// Prints median, 99 % and 99.9 % over the samples in microseconds, of each sample the least over the repetitions, which
// do the same work to the bit, so that what the operating system interposed is left out.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/simulation.h"
#include "monitor/design/design_file.h"
#include "monitor/design/make_nonlinear.h"
#include "monitor/design/make_scheduled.h"
#include "monitor/onboard/on_board_estimator.h"
#include "tests/bench/percentiles.h"
#include "tuner_design/flight/flight_engine.h"

namespace ehm::tuner_design {
namespace {

constexpr double step_s = 0.015, flown_s = 700.0;

struct Sampled {
  estimation::SensorVector sensors;
  estimation::Conditions conditions;
};

Sampled sampled(const engine_sim::EngineSample& sample) {
  Sampled s{estimation::SensorVector(as_index(sample.sensors.size())), {}};
  for (std::size_t i = 0; i < sample.sensors.size(); ++i) s.sensors(as_index(i)) = sample.sensors[i].value;
  s.conditions.flight = {sample.flight.altitude_m, sample.flight.mach, sample.flight.delta_isa_k};
  s.conditions.actuators =
      Eigen::Map<const Eigen::VectorXd>(sample.actuators.data(), as_index(sample.actuators.size()));
  return s;
}

/// Runs `work` and keeps the least time of its repetitions.
template <class Work>
void measure(double& least_us, Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
  least_us = std::min(least_us, took.count());
}

void print(const char* what, std::vector<double> us, double reference_us) {
  const double median = percentile(us, 0.5);
  std::printf("%-40s %8.2f %8.2f %8.2f %8.2f\n", what, median, percentile(us, 0.99), percentile(us, 0.999),
              median / reference_us);
}

/// Flies all samples through a clone, and keeps each one's least time. @returns those without an answer.
std::size_t measure_all(const estimation::Estimator& prototype, const std::vector<Sampled>& flight,
                        std::vector<double>& least_us) {
  const auto estimator = prototype.clone();
  const estimation::SensorMask all((1u << flight.front().sensors.size()) - 1u);
  estimator->use(all);
  estimation::Conditions before;
  std::size_t unanswered = 0;
  for (std::size_t k = 0; k < flight.size(); ++k) {
    const Sampled& now = flight[k];
    measure(least_us[k], [&] {
      estimator->predict(before, 1);
      estimator->innovate(now.sensors, now.conditions);
      estimator->update(all, 1);
    });
    before = now.conditions;
    unanswered += !estimator->estimate().holds;
  }
  return unanswered;
}

struct Measured {
  const char* what;
  std::unique_ptr<estimation::Estimator> estimator;
  std::vector<double> us;
};

std::vector<Measured> estimators_of(const std::shared_ptr<const engine_sim::EngineDefinition>& engine,
                                    const std::string& design_file) {
  using design::NonlinearKind;
  onboard::OnBoardOptions as_filed;
  as_filed.build = as_filed.soak = as_filed.inputs = false;
  const auto model = std::make_shared<const onboard::OnBoardModel>(engine, as_filed);
  const auto nonlinear = [&](NonlinearKind kind) { return design::make_nonlinear_estimator(kind, model, {}); };
  std::vector<Measured> all;
  all.push_back({"the on-board estimator, asked 40 us",
                 std::make_unique<onboard::OnBoardEstimator>(
                     std::make_shared<const onboard::OnBoardModel>(engine, onboard::OnBoardOptions{})),
                 {}});
  if (!design_file.empty())
    all.push_back({"the scheduled estimator, asked 5 us",
                   design::make_scheduled_estimator(design::read_design(design_file), {}),
                   {}});
  all.push_back({"ekf, asked 40 us", nonlinear(NonlinearKind::extended), {}});
  all.push_back({"iekf, asked 80 us", nonlinear(NonlinearKind::iterated), {}});
  all.push_back({"ukf, asked 350 us", nonlinear(NonlinearKind::unscented), {}});
  all.push_back({"particle, N = 50", nonlinear(NonlinearKind::particle), {}});
  all.push_back({"cekpf, N = 50", nonlinear(NonlinearKind::boxed_particle), {}});
  return all;
}

int run(int repetitions, const std::string& design_file) {
  const auto engine = flown_engine(*engine_sim::default_engine(), step_s);
  MissionDraw draw;
  draw.mismatch = {true, true, true};
  const auto n = static_cast<std::size_t>(flown_s / step_s);
  const double never = std::numeric_limits<double>::infinity();
  std::vector<double> simulator_us(n, never);
  std::vector<Measured> measured = estimators_of(engine, design_file);
  for (Measured& m : measured) m.us.assign(n, never);
  std::vector<Sampled> flight(n);
  std::size_t unanswered = 0;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    engine_sim::Simulation simulation(mission_scenario(engine, step_s, draw, 0));
    for (std::size_t k = 0; k < n; ++k)
      measure(simulator_us[k], [&] { flight[k] = sampled(simulation.next_sample()); });
    for (Measured& m : measured) unanswered += measure_all(*m.estimator, flight, m.us);
  }
  std::vector<double> reference = simulator_us;
  const double reference_us = percentile(reference, 0.5);
  std::printf("%-40s %8s %8s %8s %8s\n", "", "us", "99 %", "99.9 %", "ratio");
  print("the simulator's step", simulator_us, reference_us);
  for (const Measured& m : measured) print(m.what, m.us, reference_us);
  if (unanswered > 0) std::printf("%zu samples without an answer\n", unanswered);
  return unanswered > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}

}  // namespace
}  // namespace ehm::tuner_design

int main(int argc, char** argv) {
  const int repetitions = argc > 1 ? std::atoi(argv[1]) : 5;
  if (argc > 3 || repetitions < 1) {
    std::fprintf(stderr, "on_board_estimator_bench: give a number of repetitions, 1 or more, and a design file\n");
    return 2;
  }
  return ehm::tuner_design::run(repetitions, argc > 2 ? argv[2] : "");
}
