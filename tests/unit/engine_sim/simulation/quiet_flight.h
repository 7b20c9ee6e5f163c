// SPDX-License-Identifier: Apache-2.0
#pragma once
// A flight whose sensors have no noise, so that what they read is what happened.

#include "engine_sim/simulation.h"

namespace ehm::test {

inline engine_sim::Scenario quiet() {
  engine_sim::Scenario s;
  s.sensors.noise_speed_percent = s.sensors.noise_pressure_percent = s.sensors.noise_temperature_percent = 0.0;
  return s;
}

/// The last of so many samples.
inline engine_sim::SimSample fly(engine_sim::Simulation& simulation, int samples) {
  engine_sim::SimSample sample;
  for (int k = 0; k < samples; ++k) sample = simulation.next();
  return sample;
}

}  // namespace ehm::test
