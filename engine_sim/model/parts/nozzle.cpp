// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/parts/nozzle.h"

#include <cmath>

namespace ehm::engine_sim {

double sonic_temperature_k(double tt_k, double total_h_j_kg, double fuel_air_ratio) {
  const double r = gas_constant_j_kgk(fuel_air_ratio);
  const double total_cp = specific_heat_j_kgk(tt_k, fuel_air_ratio);
  double t = 2.0 * tt_k / (total_cp / (total_cp - r) + 1.0);  // as if gamma were that of the total temperature
  for (int i = 0; i < 20; ++i) {
    const GasProperty h = enthalpy_property(t, fuel_air_ratio);
    const double cp = h.by_temperature, gamma = cp / (cp - r);
    // Newton on 2 (ht - h(T)) - gamma R T, gamma taken as constant: its slope is 1e-4 of the rest
    const double step = (2.0 * (total_h_j_kg - h.value) - gamma * r * t) / (2.0 * cp + gamma * r);
    t += step;
    if (std::abs(step) < 1e-8 * t) break;  // the error left is 1e-12 or less
  }
  return t;
}

GasTemperature sonic_temperature(double tt_k, double total_h_j_kg, double fuel_air_ratio) {
  const double t = sonic_temperature_k(tt_k, total_h_j_kg, fuel_air_ratio);
  const double r = gas_constant_j_kgk(fuel_air_ratio), r_by_f = gas_constant_slope_j_kgk(fuel_air_ratio);
  const GasProperty cp = specific_heat_property(t, fuel_air_ratio), h = enthalpy_property(t, fuel_air_ratio);
  const double cv = cp.value - r, gamma = cp.value / cv, gamma_by_cp = -r / (cv * cv), gamma_by_r = gamma / cv;
  const double gamma_by_f = gamma_by_cp * cp.by_fuel_air_ratio + gamma_by_r * r_by_f;
  // (2 cp + gamma R + R T gamma_T) dT = 2 dht - (2 h_f + R T gamma_f + gamma T R_f) df
  const double slope = 2.0 * cp.value + gamma * r + r * t * gamma_by_cp * cp.by_temperature;
  const double by_f = 2.0 * h.by_fuel_air_ratio + r * t * gamma_by_f + gamma * t * r_by_f;
  return {t, 2.0 / slope, -by_f / slope};
}

}  // namespace ehm::engine_sim
