// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/thermo/gas.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ehm::engine_sim {
namespace {

/// A coefficient, or the value, of the polynomial of air (lane 0) and of the fuel's share (lane 1): one instruction
/// works on both.
using AirAndFuel [[gnu::vector_size(16)]] = double;
double mixed(AirAndFuel x, double share) {
  return x[0] + share * x[1];
}

constexpr int terms = 9;
struct Coefficients {
  AirAndFuel c[terms];  ///< constant term first
};

// Walsh & Fletcher F3.23, kJ/(kg K); the integration constants are MJ/kg and kJ/(kg K).
constexpr Coefficients specific_heat{{{0.992313, -0.718874},
                                      {0.236688, 8.747481},
                                      {-1.852148, -15.863157},
                                      {6.083152, 17.254096},
                                      {-8.893933, -10.233795},
                                      {7.097112, 3.081778},
                                      {-3.234725, -0.361112},
                                      {0.794571, -0.003919},
                                      {-0.081873, 0.0}}};
constexpr AirAndFuel enthalpy_constant{0.422178, 0.0555930};
constexpr AirAndFuel entropy_constant{0.001053, -0.0016079};

constexpr double lowest_k = 200.0;
constexpr double highest_k = 2000.0;

// integral of Z^i dZ = Z Z^i/(i+1);  integral of Z^i dZ/Z = Z Z^(i-1)/i for i > 0, ln Z for i = 0;
// d(Z^i)/dZ = i Z^(i-1)
constexpr Coefficients integrated() {
  Coefficients out{};
  for (int i = 0; i < terms; ++i) out.c[i] = specific_heat.c[i] * (1.0 / (i + 1));
  return out;
}
constexpr Coefficients integrated_over_z() {
  Coefficients out{};
  for (int i = 1; i < terms; ++i) out.c[i - 1] = specific_heat.c[i] * (1.0 / i);
  return out;
}
constexpr Coefficients differentiated() {
  Coefficients out{};
  for (int i = 1; i < terms; ++i) out.c[i - 1] = specific_heat.c[i] * i;
  return out;
}
constexpr Coefficients enthalpy_terms = integrated(), entropy_terms = integrated_over_z(),
                       slope_terms = differentiated();

/// Even and odd powers apart: two short chains of operations, which the processor runs side by side.
inline AirAndFuel polynomial(const Coefficients& p, double z) {
  const double z2 = z * z;
  const AirAndFuel even = (((p.c[8] * z2 + p.c[6]) * z2 + p.c[4]) * z2 + p.c[2]) * z2 + p.c[0];
  const AirAndFuel odd = ((p.c[7] * z2 + p.c[5]) * z2 + p.c[3]) * z2 + p.c[1];
  return even + odd * z;
}

double fuel_share(double f) {
  return f / (1.0 + f);
}
double fuel_share_slope(double f) {
  return 1.0 / ((1.0 + f) * (1.0 + f));
}

/// h or phi at one temperature, with all that an inversion needs.
struct Evaluation {
  double value;
  double cp;        ///< J/(kg K)
  double cp_slope;  ///< J/(kg K2), zero beyond the range
  double by_share;  ///< derivative with respect to the fuel's share f/(1 + f)
  double cp_by_share;
};

inline Evaluation evaluate_enthalpy(double t_k, double share) {
  const double inside_k = std::clamp(t_k, lowest_k, highest_k);
  const double z = inside_k * 1e-3, beyond_k = t_k - inside_k;  // cp constant beyond the edge
  const AirAndFuel cp = polynomial(specific_heat, z) * 1e3;
  const AirAndFuel h = (polynomial(enthalpy_terms, z) * z + enthalpy_constant) * 1e6 + cp * beyond_k;
  const double slope = beyond_k == 0.0 ? mixed(polynomial(slope_terms, z), share) : 0.0;
  return {mixed(h, share), mixed(cp, share), slope, h[1], cp[1]};
}

inline Evaluation evaluate_entropy(double t_k, double share) {
  const double inside_k = std::clamp(t_k, lowest_k, highest_k);
  const double z = inside_k * 1e-3;
  const AirAndFuel cp = polynomial(specific_heat, z) * 1e3;
  AirAndFuel phi = (specific_heat.c[0] * std::log(z) + polynomial(entropy_terms, z) * z + entropy_constant) * 1e3;
  double slope = mixed(polynomial(slope_terms, z), share);
  if (t_k != inside_k) {
    phi = phi + cp * std::log(t_k / inside_k);
    slope = 0.0;
  }
  return {mixed(phi, share), mixed(cp, share), slope, phi[1], cp[1]};
}

/// Halley's step for a property of derivative `slope` and second derivative `curvature`; converges cubically.
double halley_step(double missing, double slope, double curvature) {
  const double newton = missing / slope;
  return newton / (1.0 + 0.5 * newton * curvature / slope);
}

/// exp(x) for |x| <= 1 by its Pade approximant (2, 2), relative error x^5/720: exact enough for a step of an iteration.
double step_factor(double x) {
  const double even = 1.0 + x * x / 12.0;
  return (even + 0.5 * x) / (even - 0.5 * x);
}

// A step of 1e-4 leaves an error of its cube, times 0.1 or less: 1e-13.
constexpr double last_step = 1e-4;
constexpr int most_steps = 30;
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double specific_heat_j_kgk(double t_k, double f) {
  return 1e3 * mixed(polynomial(specific_heat, std::clamp(t_k, lowest_k, highest_k) * 1e-3), fuel_share(f));
}

double gas_constant_j_kgk(double f) {
  return 287.05287 - 0.00990 * f + 1e-7 * f * f;
}

double gas_constant_slope_j_kgk(double f) {
  return -0.00990 + 2e-7 * f;
}

GasProperty specific_heat_property(double t_k, double f) {
  const Evaluation h = evaluate_enthalpy(t_k, fuel_share(f));
  return {h.cp, h.cp_slope, fuel_share_slope(f) * h.cp_by_share};
}

GasProperty enthalpy_property(double t_k, double f) {
  const Evaluation h = evaluate_enthalpy(t_k, fuel_share(f));
  return {h.value, h.cp, fuel_share_slope(f) * h.by_share};
}

GasProperty entropy_property(double t_k, double f) {
  const Evaluation phi = evaluate_entropy(t_k, fuel_share(f));
  return {phi.value, phi.cp / t_k, fuel_share_slope(f) * phi.by_share};
}

GasTemperature temperature_from_enthalpy(double h_j_kg, double f, double guess_k) {
  if (!std::isfinite(h_j_kg)) return {nowhere, nowhere, nowhere};
  const double share = fuel_share(f);
  double t = guess_k, step = 0.0;
  Evaluation h{};
  for (int i = 0; i < most_steps; ++i) {
    h = evaluate_enthalpy(t, share);
    step = halley_step(h_j_kg - h.value, h.cp, h.cp_slope);
    t += step;
    if (std::abs(step) < last_step * std::abs(t)) break;
  }
  // dT = (dh - h_f df)/cp, both carried over the last step
  const double by_h = 1.0 / (h.cp + h.cp_slope * step);
  return {t, by_h, -by_h * fuel_share_slope(f) * (h.by_share + h.cp_by_share * step)};
}

IsentropicTemperature isentropic_change(double t_k, double f, double log_pressure_ratio) {
  const double share = fuel_share(f), r = gas_constant_j_kgk(f);
  const Evaluation from = evaluate_entropy(t_k, share);
  const double target = from.value + r * log_pressure_ratio;
  if (!std::isfinite(target)) return {nowhere, nowhere, nowhere, nowhere};
  // Halley in ln T, in which phi is nearly straight: d(phi)/d(ln T) = cp
  Evaluation phi = from;
  double t = t_k, step = 0.0;
  for (int i = 0; i < most_steps; ++i) {
    step = std::clamp(halley_step(target - phi.value, phi.cp, phi.cp_slope * t), -1.0, 1.0);
    t *= step_factor(step);
    if (std::abs(step) < last_step) break;
    phi = evaluate_entropy(t, share);
  }
  // cp2 dT2/T2 = cp1 dT1/T1 + R dln(p2/p1) + (phi_f1 - phi_f2) df
  const double by_phi = t / (phi.cp + phi.cp_slope * step * t);
  const double phi_by_share = phi.by_share + phi.cp_by_share * step;
  return {t, by_phi * from.cp / t_k, by_phi * fuel_share_slope(f) * (from.by_share - phi_by_share), by_phi * r};
}

}  // namespace ehm::engine_sim
