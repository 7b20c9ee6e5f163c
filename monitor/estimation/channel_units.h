// SPDX-License-Identifier: Apache-2.0
#pragma once
// Between the channels' units and the scaled deviations (engine_sim/linear_model/scaling.h) a filter computes with:
//   y = (sensor - trim) / scale,   u = actuator - trim,   health = trim + scale h,   sigma = scale sigma_h
// Real-time safe: yes, all of it.

#include "monitor/estimation/capacity.h"

namespace ehm::estimation {

struct ChannelUnits {
  SensorVector sensor_trim, sensor_scale;
  ActuatorVector actuator_trim;
  HealthVector health_trim, health_scale;
  AuxiliaryVector auxiliary_trim, auxiliary_scale;

  SensorVector deviation(const SensorVector& y) const noexcept { return (y - sensor_trim).cwiseQuotient(sensor_scale); }
  HealthVector health(const HealthVector& h) const noexcept { return health_trim + health_scale.cwiseProduct(h); }
  /// The other way.
  HealthVector scaled_health(const HealthVector& health) const noexcept {
    return (health - health_trim).cwiseQuotient(health_scale);
  }
  AuxiliaryVector auxiliary(const AuxiliaryVector& z) const noexcept {
    return auxiliary_trim + auxiliary_scale.cwiseProduct(z);
  }
};

}  // namespace ehm::estimation
