// SPDX-License-Identifier: Apache-2.0
#pragma once
// Steady points of an engine whose vanes and bleed valves stand where the control wants them: where a flight starts.
// The vanes are on schedule there by definition; the valves' position and the point that it gives are iterated.

#include "engine_sim/engines/control_data.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim {

/// What acts on the engine besides its control.
struct Surroundings {
  FlightCondition flight{};
  HealthVector health{};
  Offtake offtake{};
};

/// Demand and start as in solve_steady().
/// @throws as solve_steady(), and SolveError if the valves find no position
SteadyPoint solve_scheduled(const Turbofan& engine, const ControlData& data, const Surroundings& surroundings,
                            const Demand& demand, const SteadyPoint* start = nullptr);

/// The steady point that the control holds at this fan speed demand: at the demand, or at the limit that stops it,
/// which is found by flying there. A demand of zero is idle.
/// @throws SolveError if the engine does not run there as the control wants it
SteadyPoint settled(const Turbofan& engine, const ControlData& data, const Surroundings& surroundings,
                    double n1_demand_rpm);

}  // namespace ehm::engine_sim
