// SPDX-License-Identifier: Apache-2.0
#pragma once
// The EGT margin over an engine's life: engines built and misread as drawn fly a shortened mission every so many cycles
// while they wear; what each flight has learned is where the next one starts (monitor/onboard/learned.h), and after each
// the margin is told with its sigma (take_off_margin.h) and compared with that of the engine itself.
//   wear      h(n) = f_i table_i(n),   f_i = max(0, 1 + 0.3 N(0, 1)) of each engine and parameter; table: Chatterjee &
//             Litt at 0 and 3000 cycles, HPC -2.0 and -2.5 % at 3000 (their 6000 cycles are far beyond a shop visit)
//   inputs    another error of air data and fuel meter in every flight
// Errors: none; an engine that does not fly is in `failed` and in no figure.

#include <functional>
#include <memory>
#include <vector>

#include "tuner_design/flight/flight_study.h"

namespace ehm::tuner_design {

struct MarginStudyOptions {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  std::size_t engines = 20;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

inline constexpr int life_cycles = 3000, cycles_between = 300;
inline constexpr int flights_of_a_life = life_cycles / cycles_between + 1;
inline constexpr double shortened = 0.25;  ///< of the two-hour mission's times

/// Over the engines, after one of the flights of a life.
struct MarginAtCycles {
  int cycles = 0;
  double truth_k = 0, error_rms_k = 0, sigma_k = 0, coverage = 0;  ///< means over the engines
};

struct MarginStudy {
  MarginStudyOptions options;
  std::vector<FailedEngine> failed;
  std::vector<MarginAtCycles> by_cycles;
  double error_rms_k = 0, coverage = 0;  ///< of all flights
};

MarginStudy run_margin_study(
    const MarginStudyOptions& options, const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design
