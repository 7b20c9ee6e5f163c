// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/engine_sim/control/demand_study.h"

#include <cmath>
#include <cstdio>
#include <future>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/jt9d.h"
#include "engine_sim/engines/jt9d_control.h"
#include "engine_sim/model/ratings.h"
#include "tests/unit/engine_sim/control/demand_sequence.h"

namespace ehm::test {
namespace {

using namespace engine_sim;

constexpr double dt_s = 0.015;
constexpr bool smallest_counts(Figure figure) {
  return figure == lpc_margin || figure == hpc_margin;
}

StudyResult empty_result() {
  StudyResult r;
  for (std::size_t i = 0; i < figure_count; ++i) r.worst[i].value = smallest_counts(Figure(i)) ? 1e9 : -1e9;
  return r;
}

std::array<double, figure_count> figures(const EngineLimits& limit, const GasPath& gas, bool on_ground) {
  const Measurements m = measure(gas);
  const double root_theta = std::sqrt(m.theta2());
  const auto over = [](double value, double most) { return 100.0 * (value / most - 1.0); };
  return {gas.stall_margin_lpc_percent,
          gas.stall_margin_hpc_percent,
          over(m.n1_rpm, std::min(limit.n1_rpm, limit.n1_corrected_rpm * root_theta)),
          over(m.n2_rpm, std::min(limit.n2_rpm, limit.n2_corrected_rpm * root_theta)),
          over(m.t48_k, limit.t48_k),
          over(m.ps_30_pa, limit.ps_30_pa),
          -over(m.n2_corrected_rpm(), limit.idle_n2_corrected_rpm(on_ground))};
}

void keep(StudyResult& all, const StudyResult& one) {
  for (std::size_t i = 0; i < figure_count; ++i)
    if (one.worst[i].worse_than(all.worst[i], Figure(i))) all.worst[i] = one.worst[i];
  for (std::size_t i = 0; i < fuel_loop_count; ++i) all.seconds_in_loop[i] += one.seconds_in_loop[i];
  all.failures.insert(all.failures.end(), one.failures.begin(), one.failures.end());
}

StudyResult fly(const Turbofan& engine, std::uint64_t seed, double duration_s, HeatSoak heat_soak) {
  static const ControlData data = jt9d_control();
  const DemandSequence s = random_sequence(seed, duration_s);
  const bool from_ground = on_ground(s.flight);  // after lift-off the core rises to the idle of flight
  StudyResult result = empty_result();
  double time_s = 0.0;
  const auto demand_rpm = [&] {
    const double tt2_k = intake(engine.data().inlet, s.flight_at(time_s)).tt_k;
    return s.n1_corrected_rpm(time_s) * std::sqrt(tt2_k / reference_temperature_k);
  };
  try {
    ControlledEngine run(engine, data, settled(engine, data, {s.flight, s.health, {}}, demand_rpm()), heat_soak);
    for (int k = 0; time_s < duration_s; time_s = ++k * dt_s) {
      const Surroundings now{s.flight_at(time_s), s.health, {}};
      const auto [actuation, geometry, gas] = run.step(now, demand_rpm(), dt_s);
      const auto values = figures(data.limits, gas, from_ground || on_ground(now.flight));
      for (std::size_t i = 0; i < figure_count; ++i) {
        const Worst here{values[i], seed, time_s, now.flight, measure(gas).n1_corrected_rpm(), actuation.active};
        if (here.worse_than(result.worst[i], Figure(i))) result.worst[i] = here;
      }
      result.seconds_in_loop[as_size(actuation.active)] += dt_s;
    }
  } catch (const std::exception& e) {
    result.failures.push_back("sequence " + std::to_string(seed) + " after " + std::to_string(time_s) +
                              " s: " + e.what());
  }
  return result;
}

}  // namespace

bool Worst::worse_than(const Worst& other, Figure figure) const {
  return smallest_counts(figure) ? value < other.value : value > other.value;
}

StudyResult fly_sequences(std::uint64_t first, std::uint64_t count, double duration_s, HeatSoak heat_soak) {
  const Turbofan engine(jt9d());
  constexpr std::uint64_t threads = 2;
  std::array<std::future<std::vector<StudyResult>>, threads> parts;
  for (std::uint64_t t = 0; t < threads; ++t) {
    parts[t] = std::async(std::launch::async, [&engine, first, count, duration_s, heat_soak, t] {
      std::vector<StudyResult> results;
      for (std::uint64_t i = t; i < count; i += threads)
        results.push_back(fly(engine, first + i, duration_s, heat_soak));
      return results;
    });
  }
  std::array<std::vector<StudyResult>, threads> results;
  for (std::uint64_t t = 0; t < threads; ++t) results[t] = parts[t].get();
  StudyResult all = empty_result();
  for (std::uint64_t i = 0; i < count; ++i) keep(all, results[i % threads][i / threads]);
  return all;
}

std::string table(const StudyResult& r) {
  std::string text;
  char line[200];
  const auto add = [&](auto... values) {
    std::snprintf(line, sizeof line, values...);
    text += line;
  };
  add("%-24s %8s  %8s %7s %9s %6s %6s %8s  %s\n", "worst", "value", "sequence", "time s", "altitude", "Mach", "dISA",
      "N1c rpm", "fuel set by");
  for (std::size_t i = 0; i < figure_count; ++i) {
    const Worst& w = r.worst[i];
    add("%-24s %8.3f  %8llu %7.2f %9.0f %6.3f %6.1f %8.0f  %s\n", figure_names[i].data(), w.value,
        static_cast<unsigned long long>(w.seed), w.time_s, w.flight.altitude_m, w.flight.mach, w.flight.delta_isa_k,
        w.n1_corrected_rpm, fuel_loop_names[as_size(w.active)].data());
  }
  text += "time in each loop, s:";
  for (std::size_t i = 0; i < fuel_loop_count; ++i) add(" %s %.0f,", fuel_loop_names[i].data(), r.seconds_in_loop[i]);
  text.back() = '\n';
  for (const std::string& failure : r.failures) text += failure + '\n';
  return text;
}

}  // namespace ehm::test
