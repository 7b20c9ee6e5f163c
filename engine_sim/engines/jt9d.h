// SPDX-License-Identifier: Apache-2.0
#pragma once
// The JT9D-class engine of the public NPSS and T-MATS models. Units and sources: jt9d.cpp, constant by constant.

#include "engine_sim/model/engine_data.h"

namespace ehm::engine_sim {

/// Real-time safe after the first call, which builds the maps.
const EngineData& jt9d();

}  // namespace ehm::engine_sim
