// SPDX-License-Identifier: Apache-2.0
#pragma once
// The JT9D-class engine as a whole, compiled in: gas path, control and channels. deploy/engines/jt9d.json is its file.

#include <memory>

#include "engine_sim/engines/engine_definition.h"

namespace ehm::engine_sim {

const EngineDefinition& jt9d_engine();

/// The engine that flies where none is named: that one.
std::shared_ptr<const EngineDefinition> default_engine();

}  // namespace ehm::engine_sim
