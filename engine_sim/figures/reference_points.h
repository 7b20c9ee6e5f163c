// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points of another model on the component maps, from a CSV with the columns <component>_WcMap, _PRmap, _effMap and
// _NcMap of NPSS (component: Fan, LPC, HPC, HPT, LPT); coordinates and units of the unscaled maps. Rows whose column
// `conv` is not 1 are left out; other columns are ignored.

#include <string>
#include <vector>

#include "deploy/runtime/files/csv_table.h"

namespace ehm::engine_sim {

struct ReferencePoint {
  double speed, flow, pressure_ratio, efficiency;
};

/// @throws files::FileError if a column is missing or a cell is no number
std::vector<ReferencePoint> reference_points(const files::CsvTable& table, const std::string& component);

}  // namespace ehm::engine_sim
