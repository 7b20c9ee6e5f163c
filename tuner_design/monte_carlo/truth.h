// SPDX-License-Identifier: Apache-2.0
#pragma once
// The engines that an experiment flies on: constant health h and constant controls, in balance from the first sample
// on.
//
//   linear      y = trim + H h,  z = trim + Hz h,  u = 0     the design's own model, controls at trim
//   nonlinear   y, z of the steady turbofan at the design's operating point with the worn components. Held is either
//                 the fan speed, as the engine's control does it: worn engines burn another fuel flow, and the filter
//                 is told (u); this is how `linearise` measures its fleet; or
//                 the fuel flow at trim (u = 0): worn engines then turn at another speed and leave the neighbourhood
//                 in which the model was made.
//               Vanes and bleed valves are at trim. The design's trim is the origin of the deviations wherever it lies:
//               `linearise --method fleet` puts it into the middle of the fleet, not on the new engine.
//
// An engine in balance with constant health and controls stays there, so that a steady solution is a whole flight
// (tests/unit/tuner_design/monte_carlo/nonlinear_truth_test.cpp flies it). The start of the filter is cold.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine_sim/engines/engine_definition.h"
#include "monitor/design/design.h"
#include "monitor/estimation/capacity.h"
#include "tuner_design/monte_carlo/evaluation.h"

namespace ehm::tuner_design {

/// Deviations from the design's trim, channel units, without noise.
struct EngineInBalance {
  estimation::SensorVector sensors;
  estimation::AuxiliaryVector auxiliary;
  estimation::ActuatorVector controls;  ///< u
};

struct Truth {
  std::string description;
  bool nonlinear = false;
  /// The engine with this health (deviation from trim, channel units); nothing where it has no steady point. Callable
  /// by several threads at once.
  std::function<std::optional<EngineInBalance>(const estimation::HealthVector& health)> engine;
};

Truth linear_truth(const design::Design& design);

/// @throws std::invalid_argument if the design is for another engine (engine_match.h), has no operating point, or has a
///         channel that this engine does not know by name and unit; names it and what is known.
Truth nonlinear_truth(const design::Design& design, Hold hold,
                      std::shared_ptr<const engine_sim::EngineDefinition> engine);

}  // namespace ehm::tuner_design
