// SPDX-License-Identifier: Apache-2.0
#pragma once
// The gas path's part of an engine file (engine_data.h), at the root: name; inlet, fan, lpc, hpc, hpt, lpt, nozzles,
// losses, inertias, metal, ratings, design_point. A range is what a real engine can be, so that a value in another unit
// is refused.
// @throws files::FileError (file, key, value, allowed)

#include "deploy/runtime/files/json_object.h"
#include "engine_sim/model/engine_data.h"

namespace ehm::engine_sim {

/// Reads its keys of the root, not more.
EngineData engine_data_from(files::JsonObject& root);
void add_engine_data(files::Json& root, const EngineData& data);

}  // namespace ehm::engine_sim
