// SPDX-License-Identifier: Apache-2.0
#pragma once
// Shaft without friction: J dw/dt = (turbine power - compressor power)/w, in rpm/s.
//   dN/dt = (P_turbine - P_compressors) / (J w k),  w = N k,  k = 2 pi/60
// Units: W, rpm, kg m2. Errors: none (a shaft at rest gives a non-finite rate). Source: Newton's second law.

#include "engine_sim/model/units.h"

namespace ehm::engine_sim {

template <class S>
S shaft_acceleration_rpm_s(const S& surplus_power_w, const S& speed_rpm, double inertia_kg_m2) {
  return surplus_power_w / (inertia_kg_m2 * speed_rpm * rad_s_per_rpm * rad_s_per_rpm);
}

}  // namespace ehm::engine_sim
