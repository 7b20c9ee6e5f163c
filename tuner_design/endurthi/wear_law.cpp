// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/wear_law.h"

#include <cmath>

#include "tuner_design/studies/half_worn.h"

namespace ehm::tuner_design::endurthi {
namespace {

constexpr double half_life_cycles = 3000.0, life_cycles = 6000.0, run_in_cycles = 300.0;

// of the ten, in the order of health_names
constexpr engine_sim::HealthVector initial{-0.0018, -0.0026, -0.0062, -0.0101, 0.0,
                                           0.0,     -0.0048, 0.0008,  -0.0010, 0.0008};
/// After 6000 cycles; of the HPC twice what it is after 3000.
constexpr engine_sim::HealthVector worn_out{-0.0285, -0.0365, -0.0261, -0.0400, -0.0400,
                                            -0.0500, -0.0381, 0.0257,  -0.0108, 0.0042};

/// b
double slope_per_cycle(std::size_t parameter) {
  const double a = initial[parameter];
  return (half_life_cycles * (half_worn_health[parameter] - a) + life_cycles * (worn_out[parameter] - a)) /
         (half_life_cycles * half_life_cycles + life_cycles * life_cycles);
}

}  // namespace

engine_sim::HealthVector worn_after(double cycles) {
  engine_sim::HealthVector health{};
  for (std::size_t i = 0; i < health.size(); ++i)
    health[i] = initial[i] * (1.0 - std::exp(-cycles / run_in_cycles)) + slope_per_cycle(i) * cycles;
  return health;
}

}  // namespace ehm::tuner_design::endurthi
