// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/power_lever.h"

#include "engine_sim/model/parts/root_theta.h"

namespace ehm::engine_sim {

Demand demand_of_power_lever(const EngineData& engine, const EngineLimits& limits, double percent,
                             const FlightCondition& flight) {
  constexpr double at_zero = 0.12;
  const double share = at_zero + (1.0 - at_zero) * 0.01 * percent;
  return {DemandKind::n1_rpm, share * limits.n1_corrected_rpm * root_theta(engine.inlet, flight)};
}

}  // namespace ehm::engine_sim
