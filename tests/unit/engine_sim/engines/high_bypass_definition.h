// SPDX-License-Identifier: Apache-2.0
#pragma once
// How deploy/engines/high_bypass.json was made: the second engine, sized from its data sheet, with a control and channels.

#include "engine_sim/engines/engine_definition.h"

namespace ehm::engine_sim {

EngineDefinition high_bypass_definition();

}  // namespace ehm::engine_sim
