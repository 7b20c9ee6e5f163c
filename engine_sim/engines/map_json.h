// SPDX-License-Identifier: Apache-2.0
#pragma once
// Component maps in an engine file, as fitted surfaces (compressor_map.h, turbine_map.h):
//   compressor   flow_exponent, pressure_exponent, last_r_line; speed_breaks, r_line_breaks; flow, pressure,
//                efficiency: one row a speed basis function; surge_flow_breaks, surge_pressure_ratio
//   turbine      choking_rate; speed_breaks, pressure_ratio_breaks; flow, efficiency
// k + 1 ascending break points have k + 3 basis functions. Units: those of the maps.
// @throws files::FileError (file, key, value, allowed) for lists of another size, break points that do not ascend, and
//         maps on which a component cannot run (map_check.h).

#include "deploy/runtime/files/json_object.h"
#include "engine_sim/model/maps/compressor_map.h"
#include "engine_sim/model/maps/turbine_map.h"

namespace ehm::engine_sim {

CompressorMap compressor_map_from(files::JsonObject& parent, const std::string& key);
TurbineMap turbine_map_from(files::JsonObject& parent, const std::string& key);
files::Json to_json(const CompressorMap& map);
files::Json to_json(const TurbineMap& map);

}  // namespace ehm::engine_sim
