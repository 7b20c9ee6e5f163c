// SPDX-License-Identifier: Apache-2.0
#pragma once
// Inlet: ambient conditions and flight Mach number to the fan face.
//   V0 = M sqrt(gamma R T0), h_t = h(T0) + V0^2/2, isentropic total pressure by the entropy function,
//   P2 = recovery(M) * Pt0, ram drag = W2 V0
// Units: Pa, K, m/s. The recovery table is piecewise linear in Mach number and constant beyond its ends.
// Errors: @throws std::out_of_range if the Mach number is not within 0 to 0.95 (and those of atmosphere()).
// Source: Walsh & Fletcher, chapter 5 (ram recovery); table: EngineData.

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/gas_path.h"

namespace ehm::engine_sim {

/// What the engine sees of the flight condition; it does not depend on what the engine does.
struct Intake {
  double ambient_p_pa;
  double fan_face_pt_pa;
  double tt_k;
  double flight_speed_m_s;
};

/// Whether intake() covers the flight condition: Mach number 0 to 0.95, and as atmosphere(); it throws nothing then.
bool covers(const FlightCondition& flight) noexcept;

Intake intake(const InletData& inlet, const FlightCondition& flight);

}  // namespace ehm::engine_sim
