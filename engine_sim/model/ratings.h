// SPDX-License-Identifier: Apache-2.0
#pragma once
// Idle and maximum power.
//   maximum: max(T40/T40max, T48/T48max, P30/P30max, N1/N1max, N2/N2max, N1c/N1cmax, N2c/N2cmax) = 1
//   idle:    N2 = N2c_idle sqrt(theta2), on the ground (up to Mach 0.25 and 3000 m) lower than in flight
// with corrected speeds Nc = N/sqrt(theta2).
//
// The corrected speeds bound cold days and high altitudes, where T40 alone would drive the engine off its maps.
// Units: K, Pa, rpm. Errors: none. Source: the way engines are rated (Walsh & Fletcher, chapter 7); numbers:
// EngineData.

#include <cmath>

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {

/// The largest ratio to its limit. At a kink the derivative is that of the larger branch.
template <class S>
S limit_ratio(const Ratings& r, const S& t40_k, const S& t48_k, const S& p30_pa, const S& n1_rpm, const S& n2_rpm,
              double tt2_k) {
  const double root_theta = std::sqrt(tt2_k / reference_temperature_k);
  const double n1_max_rpm = std::min(r.n1_max_rpm, r.corrected_n1_max_rpm * root_theta);
  const double n2_max_rpm = std::min(r.n2_max_rpm, r.corrected_n2_max_rpm * root_theta);
  S largest = t40_k / r.t40_max_k;
  for (const S& ratio :
       {S(t48_k / r.t48_max_k), S(p30_pa / r.p30_max_pa), S(n1_rpm / n1_max_rpm), S(n2_rpm / n2_max_rpm)}) {
    if (value(ratio) > value(largest)) largest = ratio;
  }
  return largest;
}

inline double limit_ratio(const Ratings& r, const GasPath& g) {
  return limit_ratio(r, g.s40.tt_k, g.s48.tt_k, g.s30.pt_pa, g.speeds.n1_rpm, g.speeds.n2_rpm, g.s2.tt_k);
}

inline bool on_ground(const FlightCondition& flight) {
  return flight.mach <= 0.25 && flight.altitude_m <= 3000.0;
}

inline double idle_n2_rpm(const Ratings& r, const FlightCondition& flight, double tt2_k) {
  const double corrected = on_ground(flight) ? r.ground_idle_corrected_n2_rpm : r.flight_idle_corrected_n2_rpm;
  return corrected * std::sqrt(tt2_k / reference_temperature_k);
}

}  // namespace ehm::engine_sim
