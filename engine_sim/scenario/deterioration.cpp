#include "engine_sim/scenario/deterioration.h"

#include <algorithm>
#include <vector>

namespace ehm::engine {

void Deterioration::order(std::size_t parameter, double target, double ramp_s, double now_s) {
  const double present = at(now_s)[parameter];
  std::erase_if(changes_, [&](const HealthChange& c) { return c.parameter == parameter && c.time_s <= now_s; });
  wear_[parameter].initial = present - wear_[parameter].drift_per_s * now_s;
  changes_.push_back({now_s, parameter, target - present, ramp_s});
}

HealthVector Deterioration::at(double time_s) const {
  HealthVector health{};
  for (std::size_t i = 0; i < health_count; ++i) health[i] = wear_[i].initial + wear_[i].drift_per_s * time_s;
  for (const HealthChange& c : changes_) {
    if (time_s < c.time_s) continue;
    const double done = c.ramp_s > 0.0 ? std::min(1.0, (time_s - c.time_s) / c.ramp_s) : 1.0;
    health[c.parameter] += c.change * done;
  }
  return health;
}

}  // namespace ehm::engine
