// SPDX-License-Identifier: Apache-2.0
#pragma once
// A random flight of half a minute: flight condition, wear, and a fan speed demand of slams, steps, ramps, bodies and
// reversals. The same seed gives the same flight.
//   envelope: 0 to 13.5 km, M <= 0.45 + altitude/22 km, ISA -20 to +35 K;  health: each -4 to +1 %

#include <cstdint>
#include <vector>

#include "engine_sim/control/controlled_engine.h"

namespace ehm::test {

struct DemandPoint {
  double time_s;
  double n1_corrected_rpm;  ///< linear between points; two points of one time are a step
};

struct DemandSequence {
  engine_sim::FlightCondition flight;  ///< at the start
  double climb_m_s, mach_per_s;        ///< inside the envelope
  engine_sim::HealthVector health;
  std::vector<DemandPoint> demand;

  engine_sim::FlightCondition flight_at(double time_s) const;
  double n1_corrected_rpm(double time_s) const;
};

DemandSequence random_sequence(std::uint64_t seed, double duration_s);

}  // namespace ehm::test
