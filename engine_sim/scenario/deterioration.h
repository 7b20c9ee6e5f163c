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

  void add(const HealthChange& change) { changes_.push_back(change); }
  HealthVector at(double time_s) const;

 private:
  std::array<Wear, health_count> wear_;
  std::vector<HealthChange> changes_;
};

}  // namespace ehm::engine
