// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/thermo/atmosphere.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace ehm::engine_sim {

Ambient atmosphere(double altitude_m, double delta_isa_k) {
  if (!covers_altitude(altitude_m)) {
    throw std::out_of_range("atmosphere: altitude_m = " + std::to_string(altitude_m) +
                            " is outside -1000 to 20000; give a geopotential altitude in metres");
  }
  if (!covers_offset(delta_isa_k)) {
    throw std::out_of_range("atmosphere: delta_isa_k = " + std::to_string(delta_isa_k) + " is outside -60 to 60");
  }
  constexpr double t0_k = 288.15, p0_pa = 101325.0, lapse_k_m = 0.0065, g_m_s2 = 9.80665, r_j_kgk = 287.05287;
  constexpr double tropopause_m = 11000.0;
  constexpr double t11_k = t0_k - lapse_k_m * tropopause_m;
  const double t_standard_k = altitude_m < tropopause_m ? t0_k - lapse_k_m * altitude_m : t11_k;
  double p_pa = p0_pa * std::pow(t_standard_k / t0_k, g_m_s2 / (r_j_kgk * lapse_k_m));
  if (altitude_m > tropopause_m) p_pa *= std::exp(-g_m_s2 * (altitude_m - tropopause_m) / (r_j_kgk * t11_k));
  return {p_pa, t_standard_k + delta_isa_k};
}

}  // namespace ehm::engine_sim
