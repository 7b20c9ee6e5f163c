// SPDX-License-Identifier: Apache-2.0
#pragma once
// Thermodynamic properties of air and of the combustion products of kerosene in dry air, semi-perfect gas:
//   cp(T, f) = sum A_i Z^i + f/(1+f) sum B_i Z^i                Z = T / 1000 K, f = fuel-air ratio by mass
//   h(T, f)  = integral of cp dT + constant                      J/kg
//   phi(T,f) = integral of cp dT/T + constant                    J/(kg K), the entropy function
//   isentropic change of state: phi(T2, f) - phi(T1, f) = R(f) ln(p2 / p1)
// Polynomials valid for 200-2000 K and f = 0-0.05. Outside that range cp keeps the value of the edge, so h and phi
// continue once differentiably and a solver that strays out of range finds its way back.
// Units: K, J/kg, J/(kg K); f and pressure ratios are plain ratios.
// Errors: none; a target that is not finite gives a temperature that is not (a number). Relative error of the
// inversions 1e-13. Source: Walsh & Fletcher, Gas Turbine Performance, 2nd ed., formulae F3.23 (cp), F3.26 (h), F3.27
// (phi), F3.22 (R).

#include "engine_sim/model/solve/dual.h"

namespace ehm::engine_sim {

double specific_heat_j_kgk(double t_k, double fuel_air_ratio);
double gas_constant_j_kgk(double fuel_air_ratio);
double gas_constant_slope_j_kgk(double fuel_air_ratio);  ///< dR/df

/// Value with its two partial derivatives.
struct GasProperty {
  double value;
  double by_temperature;
  double by_fuel_air_ratio;
};
GasProperty specific_heat_property(double t_k, double fuel_air_ratio);
GasProperty enthalpy_property(double t_k, double fuel_air_ratio);
GasProperty entropy_property(double t_k, double fuel_air_ratio);

/// Temperature found from a property, with its partial derivatives by the implicit function theorem.
struct GasTemperature {
  double t_k;
  double by_target;
  double by_fuel_air_ratio;
};
/// T such that h(T, f) = target, from `guess_k`.
GasTemperature temperature_from_enthalpy(double h_j_kg, double fuel_air_ratio, double guess_k);

/// Temperature T2 after a change of pressure at constant entropy, with its partial derivatives.
struct IsentropicTemperature {
  double t_k;
  double by_temperature;  ///< before the change
  double by_fuel_air_ratio;
  double by_log_pressure_ratio;
};
/// T2 such that phi(T2, f) = phi(T, f) + R ln(p2/p1).
IsentropicTemperature isentropic_change(double t_k, double fuel_air_ratio, double log_pressure_ratio);

template <class S>
S enthalpy(const S& t_k, const S& fuel_air_ratio) {
  const GasProperty h = enthalpy_property(value(t_k), value(fuel_air_ratio));
  return chain(h.value, h.by_temperature, t_k, h.by_fuel_air_ratio, fuel_air_ratio);
}

template <class S>
S entropy_function(const S& t_k, const S& fuel_air_ratio) {
  const GasProperty phi = entropy_property(value(t_k), value(fuel_air_ratio));
  return chain(phi.value, phi.by_temperature, t_k, phi.by_fuel_air_ratio, fuel_air_ratio);
}

/// R varies with f by 2e-4 percent over the whole range: Newton's method needs no derivative of it, so it is carried
/// only where derivatives by parameters are asked for (P a dual number).
template <class P = double, class S>
auto gas_constant(const S& fuel_air_ratio) {
  const double f = value(fuel_air_ratio), r = gas_constant_j_kgk(f);
  if constexpr (std::is_same_v<P, double>) {
    return r;
  } else {
    return chain(r, gas_constant_slope_j_kgk(f), fuel_air_ratio);
  }
}

template <class S>
S temperature_at_enthalpy(const S& h_j_kg, const S& fuel_air_ratio, double guess_k) {
  const GasTemperature t = temperature_from_enthalpy(value(h_j_kg), value(fuel_air_ratio), guess_k);
  return chain(t.t_k, t.by_target, h_j_kg, t.by_fuel_air_ratio, fuel_air_ratio);
}

/// Temperature after an isentropic change of pressure p2/p1 = exp(log_pressure_ratio); P as for gas_constant().
template <class P = double, class S>
S isentropic_temperature(const S& t_k, const S& fuel_air_ratio, const S& log_pressure_ratio) {
  const IsentropicTemperature t = isentropic_change(value(t_k), value(fuel_air_ratio), value(log_pressure_ratio));
  if constexpr (std::is_same_v<P, double>) {
    return chain(t.t_k, t.by_temperature, t_k, t.by_fuel_air_ratio, fuel_air_ratio) +
           chain(0.0, t.by_log_pressure_ratio, log_pressure_ratio);
  } else {
    const double f = value(fuel_air_ratio), log_r_slope = gas_constant_slope_j_kgk(f) / gas_constant_j_kgk(f);
    const double by_r = t.by_log_pressure_ratio * value(log_pressure_ratio) * log_r_slope;
    return chain(t.t_k, t.by_temperature, t_k, t.by_fuel_air_ratio + by_r, fuel_air_ratio) +
           chain(0.0, t.by_log_pressure_ratio, log_pressure_ratio);
  }
}

}  // namespace ehm::engine_sim
