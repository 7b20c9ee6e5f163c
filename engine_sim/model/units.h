// SPDX-License-Identifier: Apache-2.0
#pragma once
// Conversions from the units of the maps and data sheets to SI, at the one border where they meet.
// Source: exact definitions of the international pound, foot, inch and BTU (IT); slug from standard gravity.

namespace ehm::engine_sim {

inline constexpr double kg_per_lbm = 0.45359237;
inline constexpr double pa_per_psi = 6894.757293168;
inline constexpr double m_per_ft = 0.3048;
inline constexpr double m2_per_in2 = 6.4516e-4;
inline constexpr double n_per_lbf = 4.4482216152605;
inline constexpr double rankine_per_kelvin = 1.8;
inline constexpr double j_kg_per_btu_lbm = 2326.0;
inline constexpr double kg_m2_per_slug_ft2 = 1.3558179483314;
inline constexpr double rad_s_per_rpm = 0.10471975511965978;  // 2 pi / 60

/// Reference state of corrected flow and corrected speed: 518.67 R and 14.696 psia, the maps' own convention.
inline constexpr double reference_temperature_k = 518.67 / rankine_per_kelvin;
inline constexpr double reference_pressure_pa = 14.696 * pa_per_psi;

}  // namespace ehm::engine_sim
