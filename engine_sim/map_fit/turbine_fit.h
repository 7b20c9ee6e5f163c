// SPDX-License-Identifier: Apache-2.0
#pragma once
// A turbine table fitted with the form of engine_sim/model/maps/turbine_map.h: surfaces on (speed parameter, PR),
// row-major with one row per speed basis function. Flow: g = Wp / sqrt(1 - exp(-k (PR - 1))), lbm/s sqrt(R)/psia, with
// relative errors; efficiency: ratio. All samples count alike. Method: fit_surface.h.

#include <string>
#include <vector>

#include "engine_sim/map_fit/fit_settings.h"
#include "engine_sim/map_fit/map_tables.h"
#include "engine_sim/model/maps/turbine_map.h"

namespace ehm::engine_sim {

struct TurbineFit {
  std::vector<double> flow, efficiency;
};

/// @throws files::FileError naming the settings file and key if a break point lies outside the table
/// @throws std::runtime_error if the samples do not determine the coefficients
TurbineFit fit_turbine(const TurbineSettings& settings, const TurbineTable& table);

/// The map as the engine takes it; refers to both arguments.
engine_sim::TurbineMapData map_data(const TurbineSettings& settings, const TurbineFit& fit);

/// One line: deviation of the fit from the table's samples.
std::string deviation_text(const TurbineSettings& settings, const TurbineFit& fit, const TurbineTable& table);

}  // namespace ehm::engine_sim
