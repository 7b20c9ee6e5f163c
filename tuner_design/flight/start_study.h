// SPDX-License-Identifier: Apache-2.0
#pragma once
// Does every engine of a fleet start its mission? Each start is a mission_scenario.h of its own with everything
// perturbed: trimmed at taxi, then flown for `seconds` there. It has failed if the engine finds no balance, goes out, or
// stalls (a compressor's margin is not above 0).
// Errors: none; starts that fail are in `failed`.

#include <array>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "tuner_design/flight/flight_study.h"

namespace ehm::tuner_design {

struct StartStudyOptions {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  std::size_t starts = 100'000;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

inline constexpr std::array<std::string_view, 3> stall_margins{"SmFan", "SmLPC", "SmHPC"};
inline constexpr double start_seconds = 2.0;

struct StartStudy {
  StartStudyOptions options;
  std::vector<FailedEngine> failed;
  std::array<double, stall_margins.size()> least_margin_percent{};  ///< of all starts that did not fail
};

StartStudy run_start_study(
    const StartStudyOptions& options, const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design
