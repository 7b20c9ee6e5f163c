#include "engine_sim/model/nozzle.h"

#include <cmath>

namespace ehm::engine {

double sonic_temperature_k(double tt_k, double fuel_air_ratio) {
  const double r = gas_constant_j_kgk(fuel_air_ratio);
  const double h_total = enthalpy_property(tt_k, fuel_air_ratio).value;
  double t = tt_k / 1.17;  // 2/(gamma + 1) for gamma = 1.34
  for (int i = 0; i < 20; ++i) {
    const GasProperty h = enthalpy_property(t, fuel_air_ratio);
    const double cp = h.by_temperature, gamma = cp / (cp - r);
    // Newton on 2 (ht - h(T)) - gamma R T, gamma taken as constant: its slope is 1e-4 of the rest
    const double step = (2.0 * (h_total - h.value) - gamma * r * t) / (2.0 * cp + gamma * r);
    t += step;
    if (std::abs(step) < 1e-12 * t) break;
  }
  return t;
}

}  // namespace ehm::engine
