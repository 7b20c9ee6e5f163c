// SPDX-License-Identifier: Apache-2.0
#pragma once
// Maps on which a component can run. At the break points of a fitted surface:
//   compressor   flow grows with speed; along a speed line flow does not fall and pressure ratio ends lower than it
//                begins; pressure ratio does not fall with speed; efficiency above 0, at most 1; surge pressure ratio
//                above 1 and growing with flow
//   turbine      flow above 0 and not falling with pressure ratio; efficiency above 0, at most 1
// "Does not fall" leaves a fit half a percent of waviness where the surface is flat (choke).
// @throws files::FileError naming the surface, where on the map, both values, and what is allowed

#include "deploy/runtime/files/json_object.h"
#include "engine_sim/model/maps/compressor_map.h"
#include "engine_sim/model/maps/turbine_map.h"

namespace ehm::engine_sim {

/// `object`: of the file, for messages.
void check_map(const CompressorMap& map, const files::JsonObject& object);
void check_map(const TurbineMap& map, const files::JsonObject& object);

}  // namespace ehm::engine_sim
