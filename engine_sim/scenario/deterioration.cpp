// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/deterioration.h"

#include <vector>

namespace ehm::engine_sim {

void Deterioration::order(std::size_t parameter, double target, double ramp_s, double now_s) {
  const double present = at(now_s, parameter);
  std::erase_if(changes_, [&](const PlannedChange& c) { return c.channel == parameter && c.time_s <= now_s; });
  wear_[parameter].initial = present - wear_[parameter].drift_per_s * now_s;
  changes_.push_back({now_s, parameter, target - present, ramp_s});
}

double Deterioration::at(double time_s, std::size_t parameter) const {
  return wear_[parameter].initial + wear_[parameter].drift_per_s * time_s + sum_of(changes_, parameter, time_s);
}

std::vector<double> Deterioration::at(double time_s) const {
  std::vector<double> health(wear_.size());
  for (std::size_t i = 0; i < health.size(); ++i) health[i] = at(time_s, i);
  return health;
}

}  // namespace ehm::engine_sim
