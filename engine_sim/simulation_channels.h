#pragma once
// The turbofan's channels in the order of the wire: actuators as in the linear model's u (fuel flow, vanes, bleed
// valves), the seven sensors, the ten health parameters, the four outputs that no sensor measures.

#include "engine_sim/scenario/scenario.h"
#include "engine_sim/sensors/sensor_suite.h"
#include "engine_sim/simulated_engine.h"

namespace ehm::engine_sim {

/// `nominal`: the new engine at the start of the flight, whose values are the trims.
EngineChannels channels_of(const Scenario& scenario, const SteadyPoint& nominal, const SensorSuite& sensors);

}  // namespace ehm::engine_sim
