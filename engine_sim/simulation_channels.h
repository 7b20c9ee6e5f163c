// SPDX-License-Identifier: Apache-2.0
#pragma once
// The turbofan's channels as the wire describes them: those that its engine file names, in that order, with the trims
// of the new engine. Actuators are the linear model's u.

#include "engine_sim/scenario/scenario.h"
#include "engine_sim/sensors/sensor_suite.h"
#include "engine_sim/simulated_engine.h"

namespace ehm::engine_sim {

/// `nominal`: the new engine at the start of the flight, whose values are the trims.
EngineChannels channels_of(const Scenario& scenario, const SteadyPoint& nominal, const SensorSuite& sensors);

}  // namespace ehm::engine_sim
