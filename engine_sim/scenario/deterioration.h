// SPDX-License-Identifier: Apache-2.0
#pragma once
// Health of the engine over time: initial wear, steady drift, and changes that a schedule or an operator brings.
//
//   h_i(t) = initial_i + drift_i t + what the changes of i have added by t (sum_of in scenario.h)

#include <vector>

#include "engine_sim/scenario/scenario.h"

namespace ehm::engine_sim {

class Deterioration {
 public:
  explicit Deterioration(const Scenario& scenario) : wear_(scenario.wear), changes_(scenario.health_changes) {}

  /// An operator's order: from now on the parameter moves to `target` within ramp_s, whatever was on its way; its drift
  /// and what is scheduled for later go on.
  void order(std::size_t parameter, double target, double ramp_s, double now_s);
  double at(double time_s, std::size_t parameter) const;
  /// All of them.
  std::vector<double> at(double time_s) const;

 private:
  std::vector<Wear> wear_;
  std::vector<PlannedChange> changes_;
};

}  // namespace ehm::engine_sim
