#pragma once
// Idle and maximum power.
//   maximum: max(T40/T40max, N1/N1max, N2/N2max, N1c/N1cmax, N2c/N2cmax) = 1,  Nc = N/sqrt(theta2)
//   idle:    N2 = N2c_idle sqrt(theta2), on the ground (up to Mach 0.25 and 3000 m) lower than in flight
// The corrected speeds bound cold days and high altitudes, where T40 alone would drive the engine off its maps.
// Units: K, rpm. Errors: none. Source: the way engines are rated (Walsh & Fletcher, chapter 7); numbers: EngineData.

#include <cmath>

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/units.h"

namespace ehm::engine {

/// The largest ratio to its limit. At a kink the derivative is that of the larger branch.
template <class S>
S limit_ratio(const Ratings& r, const S& t40_k, const S& n1_rpm, const S& n2_rpm, double tt2_k) {
  const double root_theta = std::sqrt(tt2_k / reference_temperature_k);
  const double n1_max_rpm = std::min(r.n1_max_rpm, r.corrected_n1_max_rpm * root_theta);
  const double n2_max_rpm = std::min(r.n2_max_rpm, r.corrected_n2_max_rpm * root_theta);
  S largest = t40_k / r.t40_max_k;
  for (const S& ratio : {S(n1_rpm / n1_max_rpm), S(n2_rpm / n2_max_rpm)}) {
    if (value(ratio) > value(largest)) largest = ratio;
  }
  return largest;
}

inline bool on_ground(const FlightCondition& flight) {
  return flight.mach <= 0.25 && flight.altitude_m <= 3000.0;
}

inline double idle_n2_rpm(const Ratings& r, const FlightCondition& flight, double tt2_k) {
  const double corrected = on_ground(flight) ? r.ground_idle_corrected_n2_rpm : r.flight_idle_corrected_n2_rpm;
  return corrected * std::sqrt(tt2_k / reference_temperature_k);
}

}  // namespace ehm::engine
