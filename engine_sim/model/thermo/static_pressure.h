#pragma once
// Static pressure of a subsonic stream of known total state through a known area:
//   W = A p V/(R T),  h(T) = h(Tt) - V^2/2,  phi(T) - phi(Tt) = R ln(p/Pt)
// Units: kg/s, Pa, K, m2. Source: continuity and isentropic flow with variable cp (Walsh & Fletcher, chapter 3).

#include "engine_sim/model/gas_path.h"

namespace ehm::engine_sim {

/// The area at which the stream runs at this Mach number, 0 < mach <= 1.
double area_at_mach_m2(const Station& total, double mach);

/// @throws SolveError if the flow chokes the area, so that no subsonic state carries it
double static_pressure_pa(const Station& total, double area_m2);

}  // namespace ehm::engine_sim
