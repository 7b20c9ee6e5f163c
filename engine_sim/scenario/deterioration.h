#pragma once
// Health of the engine over time: initial wear, steady drift, and changes that a schedule or an operator brings.
//
//   h_i(t) = initial_i + drift_i t + sum over changes c of i: c.change * clamp((t - c.time_s) / c.ramp_s, 0, 1)

#include <array>
#include <vector>

#include "engine_sim/scenario/scenario.h"

namespace ehm::engine {

class Deterioration {
 public:
  explicit Deterioration(const Scenario& scenario) : wear_(scenario.wear), changes_(scenario.health_changes) {}

  /// An operator's order: from now on the parameter moves to `target` within ramp_s, whatever was on its way; its drift
  /// and what is scheduled for later go on.
  void order(std::size_t parameter, double target, double ramp_s, double now_s);
  HealthVector at(double time_s) const;

 private:
  std::array<Wear, health_count> wear_;
  std::vector<HealthChange> changes_;
};

}  // namespace ehm::engine
