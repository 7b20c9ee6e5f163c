// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a sensor of the engine as filed reads least and most over its flights: steady points from ground idle on a cold
// day to take-off on a hot one, and from idle descent to the top of climb. For the range check of single values, which
// adds its own width; a point that the engine does not reach is left out.
// Errors: none. Some six steady points: not for the cycle path.

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/model/turbofan.h"
#include "monitor/estimation/estimator.h"

namespace ehm::onboard {

estimation::SensorSpan flight_span(const engine_sim::Turbofan& engine, const engine_sim::NamedChannels& channels);

}  // namespace ehm::onboard
