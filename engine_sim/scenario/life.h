// SPDX-License-Identifier: Apache-2.0
#pragma once
// How an engine of the JT9D's kind wears over its flights, and what maintenance gives back.
//   h_j(N) = pace_j w_j(N)      w: piecewise straight through a new engine, 3000 and 6000 cycles
//   pace_j: 1, or drawn for one engine, N(1, 0.3), at least 0
//   washed at W < N: compressors get back half of what they had lost since they were new, which is lost again as before
//   parts replaced at R < N: turbines count their cycles from R
// Source: Chatterjee & Litt's wear table; of the HPC, -2.0 and -2.5 % at 3000 cycles (Lu et al., Energies 2013, table
// 2, at half of their 6000) and twice that at 6000, an assumption, as is the share that a washing gives back. Errors:
// none.

#include <cstdint>

#include "engine_sim/model/gas_path.h"

namespace ehm::engine_sim {

struct Life {
  double cycles = 0.0, washed_at = 0.0, replaced_at = 0.0;  ///< 0: never
  HealthVector pace = [] {
    HealthVector as_the_table{};
    as_the_table.fill(1.0);
    return as_the_table;
  }();
};

/// Of one engine of a fleet: the same seed gives the same.
HealthVector drawn_pace(std::uint64_t seed);

/// Fractions of nominal, in the order of gas_path.h.
HealthVector health_of(const Life& life);

}  // namespace ehm::engine_sim
