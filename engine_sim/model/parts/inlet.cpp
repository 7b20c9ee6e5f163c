// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/parts/inlet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "engine_sim/model/thermo/atmosphere.h"
#include "engine_sim/model/thermo/gas.h"

namespace ehm::engine_sim {
namespace {

double interpolate(const std::vector<RamRecovery>& table, double mach) {
  const auto above = std::find_if(table.begin(), table.end(), [&](const RamRecovery& p) { return p.mach >= mach; });
  if (above == table.begin()) return table.front().recovery;
  if (above == table.end()) return table.back().recovery;
  const auto below = above - 1;
  return below->recovery + (above->recovery - below->recovery) * (mach - below->mach) / (above->mach - below->mach);
}

bool covers_mach(double mach) {
  return mach >= 0.0 && mach <= 0.95;
}

}  // namespace

bool covers(const FlightCondition& flight) noexcept {
  return covers_mach(flight.mach) && covers_altitude(flight.altitude_m) && covers_offset(flight.delta_isa_k);
}

Intake intake(const InletData& inlet, const FlightCondition& flight) {
  if (!covers_mach(flight.mach)) {
    throw std::out_of_range("inlet: mach = " + std::to_string(flight.mach) + " is outside 0 to 0.95");
  }
  const Ambient ambient = atmosphere(flight.altitude_m, flight.delta_isa_k);
  const double cp = specific_heat_j_kgk(ambient.t_k, 0.0), r = gas_constant_j_kgk(0.0);
  const double speed_of_sound_m_s = std::sqrt(cp / (cp - r) * r * ambient.t_k);
  const double v0_m_s = flight.mach * speed_of_sound_m_s;
  const double h_total = enthalpy(ambient.t_k, 0.0) + 0.5 * v0_m_s * v0_m_s;
  const double tt_k = temperature_at_enthalpy(h_total, 0.0, ambient.t_k);
  const double log_ram = (entropy_function(tt_k, 0.0) - entropy_function(ambient.t_k, 0.0)) / r;
  return {ambient.p_pa, ambient.p_pa * std::exp(log_ram) * interpolate(inlet.ram_recovery, flight.mach), tt_k, v0_m_s};
}

}  // namespace ehm::engine_sim
