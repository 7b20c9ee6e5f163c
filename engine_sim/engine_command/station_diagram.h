// SPDX-License-Identifier: Apache-2.0
#pragma once
// An engine for the eye: its stations with flow, total pressure and temperature at the design point, then every other
// quantity of the channel table, then what the file measures, asks for, sets and wears.

#include <iosfwd>

#include "engine_sim/engines/engine_definition.h"

namespace ehm::engine_sim {

/// @throws SolveError if the design point has no steady solution
void print_engine(const EngineDefinition& engine, std::ostream& out);

}  // namespace ehm::engine_sim
