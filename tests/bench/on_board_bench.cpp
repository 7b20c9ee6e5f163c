// SPDX-License-Identifier: Apache-2.0
// Times of the on-board model beside a step of the transient, on what an estimator asks along throttle slams at sea
// level, cruise and ceiling (slam_flight.h): speeds with a jitter of 1e-4, health of 1e-4 a sample, metal temperatures,
// fuel flow and flight condition as measured (1e-3, 1 m, Mach 1e-4).
// Usage: on_board_bench [REPETITIONS]     (default 7)
// Prints median and 99 % over the samples in microseconds, of each the least over the repetitions, which do the same
// work, so that what the operating system interposed is left out; and the median as ratio to the transient's step.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <vector>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/onboard/on_board_engine.h"
#include "tests/bench/slam_flight.h"
#include "tests/unit/engine_sim/model/envelope.h"

namespace ehm::engine_sim {
namespace {

struct Asked {
  Operation operation;
  SpoolSpeeds speeds;
  MetalTemperatures metal;
};

std::vector<ThrottleSlam> slams(const Turbofan& engine) {
  std::vector<ThrottleSlam> out;
  for (const FlightCondition& flight : slam_flights) out.emplace_back(engine, flight, 2.5);
  return out;
}

constexpr std::size_t samples_per_slam = SlamFlight::steps_per_slam;
Operation operation_at(const std::vector<ThrottleSlam>& all, std::size_t sample) {
  return all[sample / samples_per_slam].at(SlamFlight::dt_s * static_cast<double>(sample % samples_per_slam));
}

std::vector<Asked> what_an_estimator_asks(const Turbofan& engine, const std::vector<ThrottleSlam>& all) {
  std::vector<Asked> asked;
  envelope::Points random(1);
  const auto jitter = [&](double sigma) { return std::sqrt(3.0) * sigma * random.uniform(-1.0, 1.0); };
  std::optional<Transient> run;
  for (std::size_t k = 0; k < all.size() * samples_per_slam; ++k) {
    if (k % samples_per_slam == 0) run.emplace(engine, all[k / samples_per_slam].idle(), HeatSoak::with);
    Asked a{operation_at(all, k), run->speeds(), run->metal_k()};
    run->step(a.operation, SlamFlight::dt_s);
    a.speeds.n1_rpm *= 1.0 + jitter(1e-4);
    a.speeds.n2_rpm *= 1.0 + jitter(1e-4);
    for (double& h : a.operation.health) h += jitter(1e-4);
    a.operation.fuel_flow_kg_s *= 1.0 + jitter(1e-3);
    a.operation.flight.altitude_m = std::max(0.0, a.operation.flight.altitude_m + jitter(1.0));
    a.operation.flight.mach = std::max(0.0, a.operation.flight.mach + jitter(1e-4));
    asked.push_back(a);
  }
  return asked;
}

/// Least times over the repetitions of each sample.
class Times {
 public:
  explicit Times(std::size_t samples) : us_(samples, std::numeric_limits<double>::infinity()) {}
  template <class Work>
  void measure(std::size_t sample, Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    us_[sample] = std::min(us_[sample], took.count());
  }
  double quantile(double share) const {
    std::vector<double> sorted = us_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }

 private:
  std::vector<double> us_;
};

void print(const char* what, const Times& times, double reference_us) {
  std::printf("%-52s %8.2f %8.2f %8.2f\n", what, times.quantile(0.5), times.quantile(0.99),
              times.quantile(0.5) / reference_us);
}

/// Counts an evaluation without an answer.
int failures = 0;
void require(GasPathStatus status) {
  failures += status != GasPathStatus::ok;
}

constexpr std::size_t refusal_period = 50;

int run(int repetitions) {
  const Turbofan engine(jt9d());
  const std::vector<ThrottleSlam> all = slams(engine);
  const std::vector<Asked> asked = what_an_estimator_asks(engine, all);
  const std::size_t n = asked.size();
  Times step(n), plain(n), refreshed(n), derived(n), without_metal(n), refused(n / refusal_period);
  GasPath gas;
  GasPathJacobian jacobian;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    std::optional<Transient> flight;
    OnBoardEngine a(engine), b(engine), c(engine), d(engine), e(engine);
    for (std::size_t k = 0; k < n; ++k) {
      const Operation& operation = asked[k].operation;  // by name: clang 14 captures no binding
      const SpoolSpeeds& speeds = asked[k].speeds;
      const MetalTemperatures& metal = asked[k].metal;
      const Operation commanded = operation_at(all, k);
      if (k % samples_per_slam == 0) flight.emplace(engine, all[k / samples_per_slam].idle());
      step.measure(k, [&] {
        flight->output(commanded);
        flight->step(commanded, SlamFlight::dt_s);
      });
      plain.measure(k, [&] { require(a.evaluate(operation, speeds, gas, &metal)); });
      refreshed.measure(k, [&] { require(b.evaluate(operation, speeds, gas, &metal)); });
      if (k % 20 == 0) require(b.evaluate(operation, speeds, gas, jacobian, &metal));
      derived.measure(k, [&] { require(c.evaluate(operation, speeds, gas, jacobian, &metal)); });
      without_metal.measure(k, [&] { require(d.evaluate(operation, speeds, gas, jacobian)); });
      if (k % refusal_period != 0) continue;
      Operation flooded = operation;
      flooded.fuel_flow_kg_s *= 20.0;
      refused.measure(k / refusal_period, [&] { e.evaluate(flooded, speeds, gas, &metal); });
    }
  }
  const double reference_us = step.quantile(0.5);
  std::printf("%-52s %8s %8s %8s\n", "", "us", "99 %", "ratio");
  print("step of the transient (two solutions)", step, reference_us);
  print("values, never with derivatives", plain, reference_us);
  print("values, derivatives every 20 samples between", refreshed, reference_us);
  print("values and derivatives, every sample", derived, reference_us);
  print("the same without heat soak", without_metal, reference_us);
  print("no solution (twenty times the fuel)", refused, reference_us);
  if (failures > 0) std::printf("%d evaluations without an answer\n", failures);
  return failures > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}

}  // namespace
}  // namespace ehm::engine_sim

int main(int argc, char** argv) {
  const int repetitions = argc > 1 ? std::atoi(argv[1]) : 7;
  if (argc > 2 || repetitions < 1) {
    std::fprintf(stderr, "on_board_bench: give at most one number of repetitions, 1 or more\n");
    return 2;
  }
  return ehm::engine_sim::run(repetitions);
}
