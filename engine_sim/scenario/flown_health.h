// SPDX-License-Identifier: Apache-2.0
#pragma once
// The health that acts on the engine that flies: what wear, schedule and orders make of it (deterioration.h), and its
// process noise on top (disturbance/health_noise.h). In each parameter's unit. Errors: none.

#include "engine_sim/disturbance/health_noise.h"
#include "engine_sim/scenario/deterioration.h"

namespace ehm::engine_sim {

class FlownHealth {
 public:
  explicit FlownHealth(const Scenario& scenario)
      : deterioration_(scenario),
        noise_(scenario.process_noise, scenario.wear.size(), static_cast<std::uint64_t>(scenario.seed)) {}

  /// Draws the noise of the next sample; once a sample, before it is asked for.
  void next_sample() { noise_.next(); }
  /// In the sample at time_s.
  double acting(double time_s, std::size_t parameter) const {
    return deterioration_.at(time_s, parameter) + noise_.of_sample(parameter);
  }
  /// Without what is of the present sample only: what an order starts from.
  double lasting(double time_s, std::size_t parameter) const {
    return deterioration_.at(time_s, parameter) + noise_.lasting(parameter);
  }
  /// The parameter moves to `target` within ramp_s from where it is; accumulated noise goes on from there.
  void order(std::size_t parameter, double target, double ramp_s, double now_s) {
    deterioration_.order(parameter, target - noise_.lasting(parameter), ramp_s, now_s);
  }

 private:
  Deterioration deterioration_;
  HealthNoise noise_;
};

}  // namespace ehm::engine_sim
