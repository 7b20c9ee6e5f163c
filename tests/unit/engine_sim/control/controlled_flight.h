// SPDX-License-Identifier: Apache-2.0
#pragma once
// A new engine under control, flown by one demand after another; keeps the extremes of each leg.

#include <algorithm>
#include <cmath>

#include "engine_sim/control/controlled_engine.h"
#include "engine_sim/engines/jt9d.h"
#include "engine_sim/engines/jt9d_control.h"

namespace ehm::test {

constexpr double dt_s = 0.015;
inline constexpr engine_sim::FlightCondition cruise{10668.0, 0.8, 0.0}, sea_level{0.0, 0.0, 0.0},
    ceiling{13500.0, 0.9, 0.0};

inline const engine_sim::Turbofan& new_engine() {
  static const engine_sim::Turbofan engine(engine_sim::jt9d());
  return engine;
}

inline double root_theta2(const engine_sim::FlightCondition& flight) {
  return std::sqrt(engine_sim::intake(new_engine().data().inlet, flight).tt_k / engine_sim::reference_temperature_k);
}

class ControlledFlight {
 public:
  ControlledFlight(const engine_sim::FlightCondition& flight, double n1_rpm,
                   const engine_sim::ControlData& data = engine_sim::jt9d_control(),
                   const engine_sim::HealthVector& health = {})
      : around_{flight, health, {}}, engine_(new_engine(), data, settled(new_engine(), data, around_, n1_rpm)) {}

  /// Flies for `time_s` and calls `look(sample, time since the start of the leg)` at every sample.
  template <class Look>
  engine_sim::ControlledSample fly(double n1_rpm, double time_s, Look look) {
    engine_sim::ControlledSample last;
    for (int k = 0; k * dt_s < time_s; ++k) {
      last = engine_.step(around_, n1_rpm, dt_s);
      look(last, k * dt_s);
    }
    return last;
  }
  engine_sim::ControlledSample fly(double n1_rpm, double time_s) {
    return fly(n1_rpm, time_s, [](const engine_sim::ControlledSample&, double) {});
  }

 private:
  engine_sim::Surroundings around_;
  engine_sim::ControlledEngine engine_;
};

}  // namespace ehm::test
