// SPDX-License-Identifier: Apache-2.0
#pragma once
// Is a linear model of this engine? By type and by hash of the engine's content (engine_file.h); a model that states no
// hash, made before there were engine files, is taken at its type.

#include <string>

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/linear_model/linear_model.h"

namespace ehm::tuner_design {

/// @throws std::invalid_argument "WHO: the design is for the engine ..., but ... is to fly" with both types and hashes,
///         or if the model has no operating point
void require_engine(const linear_model::LinearModel& model, const engine_sim::EngineDefinition& engine,
                    const std::string& who);

}  // namespace ehm::tuner_design
