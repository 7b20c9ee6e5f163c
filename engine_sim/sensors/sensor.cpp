// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/sensors/sensor.h"

#include <cmath>
#include <limits>

namespace ehm::engine_sim {

Reading Sensor::read(double truth, double time_s, double dt_s, NoiseSource& noise) {
  const double lag_gain = options_.lag_s > 0.0 ? 1.0 - std::exp(-dt_s / options_.lag_s) : 1.0;
  lagged_ = lagged_ ? *lagged_ + lag_gain * (truth - *lagged_) : truth;

  // The noise is drawn in every sample, so that a fault changes nothing but its own sensor.
  double value = *lagged_;
  double sigma = options_.noise_sigma + options_.noise_fraction * std::abs(*lagged_);
  const double deviate = noise.normal();
  const bool holds = samples_++ % options_.held_samples != 0 && delivered_;
  if (fault_.active(time_s)) {
    switch (fault_.kind) {
      case FaultKind::bias:
        value += fault_.magnitude;
        break;
      case FaultKind::drift:
        value += fault_.magnitude * (time_s - fault_.start_s);
        break;
      case FaultKind::noise:
        sigma *= fault_.magnitude;
        break;
      case FaultKind::dropout:
        return {std::numeric_limits<double>::quiet_NaN(), false};
      case FaultKind::stuck:
        if (delivered_) return {*delivered_, true};
        break;
      case FaultKind::none:
        break;
    }
  }
  if (holds) return {*delivered_, true};
  value += sigma * deviate;
  if (options_.step > 0.0) value = options_.step * std::round(value / options_.step);
  delivered_ = value;
  return {value, true};
}

}  // namespace ehm::engine_sim
