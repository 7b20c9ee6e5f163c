// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/flight/start_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>

#include "deploy/runtime/long_work/parallel_for.h"
#include "engine_sim/simulation.h"

namespace ehm::tuner_design {
namespace {

namespace sim = engine_sim;

using Margins = std::array<double, stall_margins.size()>;
constexpr double step_s = 0.1;

/// The flown engine, asked for the stall margins instead of its own outputs.
std::shared_ptr<const sim::EngineDefinition> engine_with_margins(const sim::EngineDefinition& engine) {
  auto copy = std::make_shared<sim::EngineDefinition>(*flown_engine(engine, step_s));
  copy->channels.auxiliary.clear();
  for (const std::string_view name : stall_margins) copy->channels.auxiliary.push_back(sim::find_output(name));
  return copy;
}

/// @throws engine_sim::FlightError
Margins least_margins(const sim::Scenario& scenario) {
  sim::Simulation simulation(scenario);
  Margins least;
  least.fill(std::numeric_limits<double>::infinity());
  while (simulation.time_s() < start_seconds) {
    const sim::SimSample sample = simulation.next();
    for (std::size_t i = 0; i < least.size(); ++i) least[i] = std::min(least[i], sample.auxiliary[i]);
  }
  return least;
}

}  // namespace

StartStudy run_start_study(const StartStudyOptions& options, const std::function<void(double)>& progress) {
  const auto engine = engine_with_margins(*options.engine);
  MissionDraw draw;
  draw.seed = options.seed;
  draw.mismatch = {true, true, true};
  std::vector<Margins> margins(options.starts);
  std::vector<std::string> why(options.starts);
  long_work::parallel_for(
      options.starts, options.threads,
      [&](std::size_t i) {
        try {
          margins[i] = least_margins(mission_scenario(engine, step_s, draw, i));
          for (std::size_t k = 0; k < stall_margins.size(); ++k)
            if (!(margins[i][k] > 0.0)) why[i] = fmt::format("stalls: {} is {:.2f} %", stall_margins[k], margins[i][k]);
        } catch (const std::exception& e) {
          why[i] = e.what();
        }
      },
      [&](std::size_t done) { progress(static_cast<double>(done) / static_cast<double>(options.starts)); });
  StartStudy study{.options = options, .failed = {}};
  study.least_margin_percent.fill(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < options.starts; ++i) {
    if (!why[i].empty()) {
      study.failed.push_back({i, why[i]});
      continue;
    }
    for (std::size_t k = 0; k < stall_margins.size(); ++k)
      study.least_margin_percent[k] = std::min(study.least_margin_percent[k], margins[i][k]);
  }
  return study;
}

}  // namespace ehm::tuner_design
