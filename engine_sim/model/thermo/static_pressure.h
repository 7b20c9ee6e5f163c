// SPDX-License-Identifier: Apache-2.0
#pragma once
// Static pressure of a subsonic stream of known total state through a known area:
//   W = A p V/(R T),  h(T) = h(Tt) - V^2/2,  phi(T) - phi(Tt) = R ln(p/Pt)
// Units: kg/s, Pa, K, m2. Errors: none; a choked area has no state. Source: Walsh & Fletcher, chapter 3, variable cp.

#include <optional>

#include "engine_sim/model/gas_path.h"
#include "engine_sim/model/solve/dual.h"

namespace ehm::engine_sim {

/// The area at which the stream runs at this Mach number, 0 < mach <= 1.
double area_at_mach_m2(const Station& total, double mach);

/// The stream in the area.
struct SubsonicState {
  double p_pa, t_k, v_m_s, mach_squared;
};
/// None if the flow chokes the area, so that no subsonic state carries it.
std::optional<SubsonicState> subsonic_state(const Station& total, double area_m2) noexcept;

/// Partial derivatives of p by the total state, from the differentials of the three equations above.
struct StaticPressureSlopes {
  double by_flow, by_pt, by_tt, by_fuel_air_ratio;
};
StaticPressureSlopes static_pressure_slopes(const Station& total, const SubsonicState& at) noexcept;

inline double static_pressure(const Station& /*total*/, const SubsonicState& at) {
  return at.p_pa;
}
template <std::size_t N>
Dual<N> static_pressure(const StationOf<Dual<N>>& total, const SubsonicState& at) {
  const auto& [w, pt, tt, f] = total;
  const StaticPressureSlopes s = static_pressure_slopes({w.v, pt.v, tt.v, f.v}, at);
  return chain(at.p_pa, s.by_flow, w, s.by_pt, pt) + chain(0.0, s.by_tt, tt, s.by_fuel_air_ratio, f);
}

}  // namespace ehm::engine_sim
