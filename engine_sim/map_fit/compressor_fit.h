// SPDX-License-Identifier: Apache-2.0
#pragma once
// A compressor table fitted with the form of model/maps/compressor_map.h. Three surfaces on (n, R), row-major with one
// row per speed basis function: phi (lbm/s), psi and efficiency (ratios), and the surge line PRsurge(Wc) from the
// table's first R-line. Weights and the continuation beyond the table: compressor_table.h; method: fit_surface.h.

#include <string>
#include <vector>

#include "engine_sim/map_fit/fit_settings.h"
#include "engine_sim/model/maps/compressor_map.h"

namespace ehm::engine_sim {

struct CompressorFit {
  std::vector<double> flow, pressure, efficiency, surge;
  double last_r_line;
};

/// @throws files::FileError naming the settings file and key if a break point or the corner does not suit the table
/// @throws std::runtime_error if the samples do not determine the coefficients
CompressorFit fit_compressor(const CompressorSettings& settings, const CompressorTable& table);

/// The map as the engine takes it; refers to both arguments.
engine_sim::CompressorMapData map_data(const CompressorSettings& settings, const CompressorFit& fit);

/// One line: deviation of the fit from the table's samples of full weight.
std::string deviation_text(const CompressorSettings& settings, const CompressorFit& fit, const CompressorTable& table);

}  // namespace ehm::engine_sim
