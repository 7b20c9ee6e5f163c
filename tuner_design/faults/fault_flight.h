// SPDX-License-Identifier: Apache-2.0
#pragma once
// One engine of the fleet flies before the very cycle that the monitor flies: nonlinear engine, its control holding the
// fan speed at the design's operating point, sensors with the noise of the simulator, no DDS.
//
// Health is drawn from the design's fleet, h ~ N(0, Ph). The filter gets the time to converge; then the case breaks, at
// a random moment. What the monitor says from there on is its answer; what it said before is a false alarm.

#include <cstdint>
#include <memory>

#include "engine_sim/engines/engine_definition.h"
#include "monitor/cycle/prepared_design.h"
#include "tuner_design/faults/fault_answer.h"
#include "tuner_design/faults/fault_case.h"

namespace ehm::tuner_design {

/// What flies, and before which design.
struct StudyEngine {
  monitor::PreparedDesign prepared;
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
};

/// @throws std::invalid_argument if the design is for another engine (engine_match.h), or has other sensors, controls
///         or health parameters than it (names them).
StudyEngine study_engine(const design::Design& design, std::shared_ptr<const engine_sim::EngineDefinition> engine);

/// The same seed and index give the same flight. Callable by several threads at once.
FaultOutcome fly_case(const StudyEngine& study, const FaultCase& what, std::uint64_t seed, std::uint64_t index);

/// A flight of `seconds` with nothing broken; false alarms are counted after convergence.
FaultOutcome fly_healthy(const StudyEngine& study, double seconds, std::uint64_t seed, std::uint64_t index);

}  // namespace ehm::tuner_design
