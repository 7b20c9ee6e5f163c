// SPDX-License-Identifier: Apache-2.0
#pragma once
// The fitted maps as C++: one source file with the coefficients, to nine digits, and one header with an accessor a map,
// named as the map in lower case. Compiled into the program, because the engine model reads no file.

#include <string>
#include <vector>

#include "engine_sim/map_fit/compressor_fit.h"
#include "engine_sim/map_fit/turbine_fit.h"

namespace ehm::engine_sim {

/// Fits in the order of the settings, and a line each on how well they fit.
struct MapFits {
  std::vector<CompressorFit> compressors;
  std::vector<TurbineFit> turbines;
  std::vector<std::string> compressor_deviations, turbine_deviations;
};

std::string source_text(const FitSettings& settings, const MapFits& fits);
std::string header_text(const FitSettings& settings);

}  // namespace ehm::engine_sim
