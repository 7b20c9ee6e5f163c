// SPDX-License-Identifier: Apache-2.0
#pragma once
// The two-hour mission of one engine of a fleet: worn by the fleet's spread, built and misread as drawn, on a day and
// with an off-take of its own. The same seed and index give the same flight on any number of threads.
//   health   sigma of the engine file, at most 3 of it          mismatch   drawn_mismatch (engine_sim/mismatch)
//   day      ISA + N(0, 8 K), at most 20 K                      off-take   0.5 to 1.5 of the mission's
//   power    0.99 to 1.01 of the mission's
// Errors: none.

#include <cstdint>
#include <memory>
#include <optional>

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/mismatch/mismatch.h"
#include "engine_sim/scenario/scenario.h"

namespace ehm::tuner_design {

/// One health parameter steps in flight: by turns down the list, from engine to engine, up or down.
struct StepOfHealth {
  double at_s;
  double percent;
};

/// One sensor becomes biased: by turns down the list, from engine to engine, up or down, by so many of its sigmas at 15
/// ms, of the present reading. Who flies the scenario does that to the readings.
struct BiasOfSensor {
  double at_s;
  double sigmas;
};

/// What differs between the engines of a fleet.
struct MissionDraw {
  std::uint64_t seed = 1;
  engine_sim::MismatchDraw mismatch;
  bool heat_soak = true;
  std::optional<StepOfHealth> step;
  std::optional<BiasOfSensor> bias;
};

/// The health channel that steps in flight number `index`.
std::size_t stepped_channel(const engine_sim::EngineDefinition& engine, std::size_t index);

/// The sensor that becomes biased in flight number `index`.
std::size_t biased_sensor(const engine_sim::EngineDefinition& engine, std::size_t index);

engine_sim::Scenario mission_scenario(std::shared_ptr<const engine_sim::EngineDefinition> engine, double step_s,
                                      const MissionDraw& draw, std::size_t index);

}  // namespace ehm::tuner_design
