// SPDX-License-Identifier: Apache-2.0
#pragma once
// First-order lags of sensors by kind, for those whose engine file states none: a file for studies at one point leaves
// them out, a flight over its slams has them. Defaults: those of AGTF30 (NASA). Units: s. Errors: none.

#include "engine_sim/engines/engine_definition.h"

namespace ehm::engine_sim {

struct SensorLags {
  double speed_s = 0.02, pressure_s = 0.04, temperature_s = 0.7;

  /// Of a sensor with this unit; one of another kind has none.
  double of(std::string_view unit) const {
    return unit == "rpm" ? speed_s : unit == "Pa" ? pressure_s : unit == "K" ? temperature_s : 0.0;
  }
};

/// The sensors with these lags where they state none.
inline void add_lags(const SensorLags& lags, std::vector<SensorChannel>& sensors) {
  for (SensorChannel& sensor : sensors)
    if (sensor.lag_s == 0.0) sensor.lag_s = lags.of(sensor.quantity->unit);
}

}  // namespace ehm::engine_sim
