// SPDX-License-Identifier: Apache-2.0
#pragma once
// sqrt(theta2), theta2 = Tt2 / reference_temperature_k (288.15 K): what a speed is divided by to become a corrected one, N/sqrt(theta2).
// Errors: @throws std::out_of_range for a flight condition that intake() does not cover.

#include <cmath>

#include "engine_sim/model/parts/inlet.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {

inline double root_theta(const InletData& inlet, const FlightCondition& flight) {
  return std::sqrt(intake(inlet, flight).tt_k / reference_temperature_k);
}

}  // namespace ehm::engine_sim
