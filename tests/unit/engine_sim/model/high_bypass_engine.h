// SPDX-License-Identifier: Apache-2.0
#pragma once
// The second engine: pyCycle's published high-bypass turbofan at its design point (35 000 ft, M 0.8).

#include "engine_sim/model/sizing.h"

namespace ehm::engine_sim {

EngineDesign high_bypass_design();

}  // namespace ehm::engine_sim
