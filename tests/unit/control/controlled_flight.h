#pragma once
// A new engine under control, flown by one demand after another; keeps the extremes of each leg.

#include <algorithm>
#include <cmath>

#include "engine_sim/control/controlled_engine.h"
#include "engine_sim/control/jt9d_control.h"
#include "engine_sim/model/engines/jt9d.h"

namespace ehm::test {

constexpr double dt_s = 0.015;
inline constexpr engine::FlightCondition cruise{10668.0, 0.8, 0.0}, sea_level{0.0, 0.0, 0.0},
    ceiling{13500.0, 0.9, 0.0};

inline const engine::Turbofan& new_engine() {
  static const engine::Turbofan engine(engine::jt9d());
  return engine;
}

inline double root_theta2(const engine::FlightCondition& flight) {
  return std::sqrt(engine::intake(new_engine().data().inlet, flight).tt_k / engine::reference_temperature_k);
}

class ControlledFlight {
 public:
  ControlledFlight(const engine::FlightCondition& flight, double n1_rpm,
                   const engine::ControlData& data = engine::jt9d_control(), const engine::HealthVector& health = {})
      : around_{flight, health, {}}, engine_(new_engine(), data, settled(new_engine(), data, around_, n1_rpm)) {}

  /// Flies for `time_s` and calls `look(sample, time since the start of the leg)` at every sample.
  template <class Look>
  engine::ControlledSample fly(double n1_rpm, double time_s, Look look) {
    engine::ControlledSample last;
    for (int k = 0; k * dt_s < time_s; ++k) {
      last = engine_.step(around_, n1_rpm, dt_s);
      look(last, k * dt_s);
    }
    return last;
  }
  engine::ControlledSample fly(double n1_rpm, double time_s) {
    return fly(n1_rpm, time_s, [](const engine::ControlledSample&, double) {});
  }

 private:
  engine::Surroundings around_;
  engine::ControlledEngine engine_;
};

}  // namespace ehm::test
