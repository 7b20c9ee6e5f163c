// SPDX-License-Identifier: Apache-2.0
#pragma once
// Seeded points of the engine's envelope, for tests: altitude 0 to 13.5 km, Mach number 0 to 0.9 but at most
// 0.45 + altitude/22 km, ISA -20 to +35 K, health of each component on its own.

#include <cstdint>
#include <random>

#include "engine_sim/model/turbofan.h"

namespace ehm::engine_sim::envelope {

class Points {
 public:
  explicit Points(std::uint64_t seed) : generator_(seed) {}

  /// The same on every platform: the standard distributions are not.
  double uniform(double from, double to) {
    return from + (to - from) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  FlightCondition flight() {
    FlightCondition f;
    do {
      f.altitude_m = uniform(0.0, 13500.0);
      f.mach = uniform(0.0, 0.9);
      f.delta_isa_k = uniform(-20.0, 35.0);
    } while (f.mach > 0.45 + f.altitude_m / 22000.0);
    return f;
  }
  /// Every component -15 to +5 %, turbine flows -5 to +5 %.
  HealthVector health() {
    HealthVector h;
    for (std::size_t i = 0; i < health_count; ++i)
      h[i] = i == hpt_flow || i == lpt_flow ? uniform(-0.05, 0.05) : uniform(-0.15, 0.05);
    return h;
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace ehm::engine_sim::envelope
