// SPDX-License-Identifier: Apache-2.0
#pragma once
// The picture of a turbine map in the engine's own coordinates, two panels over the expansion ratio: flow parameter
// along lines of constant speed, and contours of efficiency over speed.
//   Wp = s_wc WpMap, in kg/s sqrt(K)/kPa;  PR = 1 + s_pr (PRmap - 1);  eff = s_eff effMap
// The speed is the map's: N/sqrt(T) in percent of design. Flow and T are those before the inlet cooling air.
// Errors: none.

#include <functional>
#include <string>
#include <vector>

#include "engine_sim/figures/figure.h"
#include "engine_sim/figures/operating_line.h"
#include "engine_sim/figures/reference_points.h"

namespace ehm::engine_sim {

/// Which part of a map is shown; the expansion ratios are the map's own, unscaled.
struct TurbineView {
  std::string name, title;
  std::vector<double> speeds_percent;  ///< of the lines, ascending
  double lowest_pressure_ratio, highest_pressure_ratio;
};

/// Where one steady point lies: on the map's speed, and at the engine's expansion ratio.
struct TurbinePlace {
  double speed_percent, pressure_ratio;
};
using TurbineReader = std::function<TurbinePlace(const SteadyPoint&)>;

Figure turbine_figure(const TurbineView& view, const TurbineData& turbine, const std::vector<OperatingLine>& operating,
                      const TurbineReader& place_of, const std::vector<ReferencePoint>& reference);

}  // namespace ehm::engine_sim
