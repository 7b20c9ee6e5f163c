// SPDX-License-Identifier: Apache-2.0
#pragma once
// A position servo: first-order lag towards its command, limited in rate.
//   x <- x + clamp((command - x) (1 - exp(-dt/lag)), -falling dt, rising dt)        lag 0: only the rate limits
// Units: those of the position and per second. Errors: none. Real-time safe: yes.

#include <cmath>

#include "engine_sim/engines/control_data.h"

namespace ehm::engine_sim {

class Actuator {
 public:
  Actuator(const ActuatorData& data, double position) : data_(data), position_(position) {}

  double move(double command, double dt_s) {
    const double share = data_.lag_s > 0.0 ? -std::expm1(-dt_s / data_.lag_s) : 1.0;
    const double way = share * (command - position_);
    if (way > data_.rising_per_s * dt_s) return position_ += data_.rising_per_s * dt_s;
    if (way < -data_.falling_per_s * dt_s) return position_ -= data_.falling_per_s * dt_s;
    return position_ = share == 1.0 ? command : position_ + way;
  }
  double position() const { return position_; }

 private:
  ActuatorData data_;
  double position_;
};

}  // namespace ehm::engine_sim
