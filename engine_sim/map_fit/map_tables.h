// SPDX-License-Identifier: Apache-2.0
#pragma once
// The tables of a compressor or turbine map, read from the file of map tables. Keys, units, ranges: fit_settings.h.

#include <string>
#include <vector>

#include "deploy/runtime/files/json_object.h"
#include "engine_sim/map_fit/compressor_table.h"

namespace ehm::engine_sim {

/// Rows: speeds, columns: expansion ratios. Flow w sqrt(T)/p in lbm/s sqrt(R)/psia.
struct TurbineTable {
  std::vector<double> speed, pressure_ratio;
  Eigen::MatrixXd flow, efficiency;
};

/// `maps`: the content of `file`, `name`: key of the map.
/// @throws files::FileError naming file, key, value and allowed range if a key is missing, if a table has not the size
///         of its vectors, if a number is out of range, or if a speed line is clipped but for one sample or less
CompressorTable read_compressor_table(const files::Json& maps, const std::string& file, const std::string& name);
/// @throws files::FileError as above
TurbineTable read_turbine_table(const files::Json& maps, const std::string& file, const std::string& name);

}  // namespace ehm::engine_sim
