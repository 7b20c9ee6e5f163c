// SPDX-License-Identifier: Apache-2.0
#pragma once
// Health of an engine after 3000 of 6000 cycles, fractions of nominal, in the order of engine_sim::health_names: the
// trim at which Simon & Garg linearise ("fleet average, 50 percent deteriorated").
// Source: Chatterjee & Litt's wear table for fan, LPC and turbines; for the HPC, whose wear Lu et al. (Energies 2013,
// table 2) give at 6000 cycles only, -2.0 and -2.5 %.

#include "engine_sim/model/gas_path.h"

namespace ehm::tuner_design {

inline constexpr engine_sim::HealthVector half_worn_health{-0.0150, -0.0204, -0.0146, -0.0208, -0.0200,
                                                           -0.0250, -0.0263, 0.0176,  -0.0054, 0.0026};

}  // namespace ehm::tuner_design
