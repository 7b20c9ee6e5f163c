// SPDX-License-Identifier: Apache-2.0
#pragma once
// The picture of a compressor map in the engine's own coordinates: corrected flow and pressure ratio.
//   Wc = s_wc WcMap lbm/s (here kg/s at 288.15 K and 14.696 psia);  PR = 1 + s_pr (PRmap - 1);  eff = s_eff effMap
// Stall margins are defined on the unscaled map (compressor.h): they cannot be read off this picture.
// Errors: none.

#include <functional>
#include <string>
#include <vector>

#include "engine_sim/figures/figure.h"
#include "engine_sim/figures/operating_line.h"
#include "engine_sim/figures/reference_points.h"

namespace ehm::engine_sim {

/// Which part of a map is shown.
struct CompressorView {
  std::string name, title;
  std::vector<double> speeds;  ///< of the lines, relative to design corrected speed, ascending
  double highest_r_line;       ///< each line runs from surge, R = 1, to here
};

/// Where one steady point lies on the map.
struct CompressorPlace {
  double speed, r_line;
};
using CompressorReader = std::function<CompressorPlace(const SteadyPoint&)>;

Figure compressor_figure(const CompressorView& view, const CompressorData& compressor,
                         const std::vector<OperatingLine>& operating, const CompressorReader& place_of,
                         const std::vector<ReferencePoint>& reference);

}  // namespace ehm::engine_sim
