// SPDX-License-Identifier: Apache-2.0
#pragma once
// International Standard Atmosphere up to 20 km, with a temperature offset at unchanged pressure:
//   troposphere (to 11 km):  T = T0 - L z,    p = p0 (T/T0)^(g/(R L))
//   lower stratosphere:      T = T11,         p = p11 exp(-g (z - z11)/(R T11))
// z geopotential altitude in m, T in K, p in Pa. Source: ISO 2533:1975, equations 12 and 13.

namespace ehm::engine_sim {

struct Ambient {
  double p_pa;
  double t_k;
};

/// Whether atmosphere() covers it: -1 000 to 20 000 m, -60 to +60 K; not if it is no number.
constexpr bool covers_altitude(double altitude_m) {
  return altitude_m >= -1000.0 && altitude_m <= 20000.0;
}
constexpr bool covers_offset(double delta_isa_k) {
  return delta_isa_k >= -60.0 && delta_isa_k <= 60.0;
}

/// @throws std::out_of_range if the altitude is not within -1 000 to 20 000 m, or the offset not within -60 to +60 K
Ambient atmosphere(double altitude_m, double delta_isa_k);

}  // namespace ehm::engine_sim
