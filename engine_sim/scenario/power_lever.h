// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a power lever asks for: fan speed, as the control governs it.
//   n1_rpm = (0.12 + 0.88 p/100) N1c_limit sqrt(theta2)
// p: 0 to 100 percent of the lever's way. 100 asks for the control's limit of corrected fan speed; 0 lies below every
// idle, so that the idle loop decides, and the first part of the way does nothing, as on an engine.
// Errors: @throws std::out_of_range for a flight condition outside atmosphere or inlet.

#include "engine_sim/engines/control_data.h"
#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim {

Demand demand_of_power_lever(const EngineData& engine, const EngineLimits& limits, double percent,
                             const FlightCondition& flight);

}  // namespace ehm::engine_sim
