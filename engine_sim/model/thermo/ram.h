// SPDX-License-Identifier: Apache-2.0
#pragma once
// Standard-day ratios of the total conditions in front of an engine, with a perfect gas and without inlet loss, for
// what is only scaled by them (corrected speed, similarity) and need not be the engine's own:
//   T2 = T0 (1 + 0.2 M^2),  P2 = p0 (1 + 0.2 M^2)^3.5;   theta = T2/288.15 K,  delta = P2/101325 Pa
// Errors: none; not a number where the atmosphere is not known, or for a word that is none. Source: Walsh & Fletcher,
// ch. 4.

#include <cmath>
#include <limits>

#include "engine_sim/model/thermo/atmosphere.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {

struct RamRatios {
  double theta, delta;
};

inline RamRatios ram_ratios(double altitude_m, double mach, double delta_isa_k) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!covers_altitude(altitude_m) || !covers_offset(delta_isa_k) || !std::isfinite(mach)) return {none, none};
  const Ambient ambient = atmosphere(altitude_m, delta_isa_k);
  const double total = 1.0 + 0.2 * mach * mach;
  return {ambient.t_k * total / reference_temperature_k, ambient.p_pa * std::pow(total, 3.5) / reference_pressure_pa};
}

}  // namespace ehm::engine_sim
