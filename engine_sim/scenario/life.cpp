// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/life.h"

#include <algorithm>
#include <array>

#include "deploy/runtime/numbers/noise_source.h"

namespace ehm::engine_sim {
namespace {

constexpr double pace_spread = 0.3, given_back = 0.5, half_life_cycles = 3000.0;

struct Wear {
  Health parameter;
  std::array<double, 3> percent;  ///< new, at 3000 and at 6000 cycles
  bool compressor;
};
constexpr Wear table[] = {{fan_efficiency, {-0.18, -1.50, -2.85}, true},  {fan_flow, {-0.26, -2.04, -3.65}, true},
                          {lpc_efficiency, {-0.62, -1.46, -2.61}, true},  {lpc_flow, {-1.01, -2.08, -4.00}, true},
                          {hpc_efficiency, {0.0, -2.0, -4.0}, true},      {hpc_flow, {0.0, -2.5, -5.0}, true},
                          {hpt_efficiency, {-0.48, -2.63, -3.81}, false}, {hpt_flow, {0.08, 1.76, 2.57}, false},
                          {lpt_efficiency, {-0.10, -0.54, -1.08}, false}, {lpt_flow, {0.08, 0.26, 0.42}, false}};

double percent_at(const Wear& wear, double cycles) {
  const double half_lives = std::clamp(cycles / half_life_cycles, 0.0, 2.0);
  const std::size_t from = half_lives < 1.0 ? 0 : 1;
  return wear.percent[from] + (half_lives - static_cast<double>(from)) * (wear.percent[from + 1] - wear.percent[from]);
}

}  // namespace

HealthVector drawn_pace(std::uint64_t seed) {
  NoiseSource random(seed);
  HealthVector pace{};
  for (double& p : pace) p = std::max(0.0, 1.0 + pace_spread * random.normal());
  return pace;
}

HealthVector health_of(const Life& life) {
  HealthVector health{};
  for (const Wear& wear : table) {
    const bool replaced = !wear.compressor && life.replaced_at > 0.0 && life.replaced_at <= life.cycles;
    double percent = percent_at(wear, replaced ? life.cycles - life.replaced_at : life.cycles);
    if (wear.compressor && life.washed_at > 0.0 && life.washed_at <= life.cycles)
      percent -= given_back * (percent_at(wear, life.washed_at) - wear.percent[0]);
    health[wear.parameter] = 0.01 * life.pace[wear.parameter] * percent;
  }
  return health;
}

}  // namespace ehm::engine_sim
