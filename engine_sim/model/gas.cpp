#include "engine_sim/model/gas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace ehm::engine {
namespace {

// Walsh & Fletcher F3.23, kJ/(kg K); the integration constants are MJ/kg and kJ/(kg K).
constexpr std::array<double, 9> air{0.992313, 0.236688,  -1.852148, 6.083152, -8.893933,
                                    7.097112, -3.234725, 0.794571,  -0.081873};
constexpr double air_enthalpy_constant = 0.422178;
constexpr double air_entropy_constant = 0.001053;
constexpr std::array<double, 8> fuel{-0.718874,  8.747481, -15.863157, 17.254096,
                                     -10.233795, 3.081778, -0.361112,  -0.003919};
constexpr double fuel_enthalpy_constant = 0.0555930;
constexpr double fuel_entropy_constant = -0.0016079;

constexpr double lowest_k = 200.0;
constexpr double highest_k = 2000.0;

template <std::size_t N>
constexpr std::array<double, N> divided_by_power(const std::array<double, N>& c, double first_power) {
  std::array<double, N> out{};
  for (std::size_t i = 0; i < N; ++i) out[i] = i + first_power > 0.0 ? c[i] / (i + first_power) : 0.0;
  return out;
}
// integral of Z^i dZ = Z^(i+1)/(i+1); integral of Z^(i-1) dZ = Z^i/i for i > 0, ln Z for i = 0
constexpr auto air_enthalpy = divided_by_power(air, 1.0);
constexpr auto fuel_enthalpy = divided_by_power(fuel, 1.0);
constexpr auto air_entropy = divided_by_power(air, 0.0);
constexpr auto fuel_entropy = divided_by_power(fuel, 0.0);

template <std::size_t N>
double polynomial(const std::array<double, N>& c, double z) {
  double sum = 0.0;
  for (std::size_t i = N; i-- > 0;) sum = sum * z + c[i];
  return sum;
}

double fuel_share(double f) {
  return f / (1.0 + f);
}
double fuel_share_slope(double f) {
  return 1.0 / ((1.0 + f) * (1.0 + f));
}

void require_finite(double target, const char* name) {
  if (!std::isfinite(target)) {
    throw std::domain_error(std::string("gas: cannot find a temperature for a non-finite ") + name);
  }
}

}  // namespace

double specific_heat_j_kgk(double t_k, double f) {
  const double z = std::clamp(t_k, lowest_k, highest_k) * 1e-3;
  return 1e3 * (polynomial(air, z) + fuel_share(f) * polynomial(fuel, z));
}

double gas_constant_j_kgk(double f) {
  return 287.05287 - 0.00990 * f + 1e-7 * f * f;
}

GasProperty enthalpy_property(double t_k, double f) {
  const double inside_k = std::clamp(t_k, lowest_k, highest_k);
  const double z = inside_k * 1e-3;
  const double cp_fuel = 1e3 * polynomial(fuel, z);
  const double cp = 1e3 * polynomial(air, z) + fuel_share(f) * cp_fuel;
  const double h_air = 1e6 * (z * polynomial(air_enthalpy, z) + air_enthalpy_constant);
  const double h_fuel = 1e6 * (z * polynomial(fuel_enthalpy, z) + fuel_enthalpy_constant);
  const double beyond_k = t_k - inside_k;  // cp constant beyond the edge
  return {h_air + fuel_share(f) * h_fuel + cp * beyond_k, cp, fuel_share_slope(f) * (h_fuel + cp_fuel * beyond_k)};
}

GasProperty entropy_property(double t_k, double f) {
  const double inside_k = std::clamp(t_k, lowest_k, highest_k);
  const double z = inside_k * 1e-3;
  const double log_z = std::log(z);
  const double cp_fuel = 1e3 * polynomial(fuel, z);
  const double cp = 1e3 * polynomial(air, z) + fuel_share(f) * cp_fuel;
  const double phi_air = 1e3 * (air[0] * log_z + polynomial(air_entropy, z) + air_entropy_constant);
  const double phi_fuel = 1e3 * (fuel[0] * log_z + polynomial(fuel_entropy, z) + fuel_entropy_constant);
  const double beyond = t_k == inside_k ? 0.0 : std::log(t_k / inside_k);
  return {phi_air + fuel_share(f) * phi_fuel + cp * beyond, cp / t_k,
          fuel_share_slope(f) * (phi_fuel + cp_fuel * beyond)};
}

double temperature_from_enthalpy(double h_j_kg, double f, double guess_k) {
  require_finite(h_j_kg, "enthalpy");
  double t = guess_k;
  for (int i = 0; i < 30; ++i) {
    const GasProperty h = enthalpy_property(t, f);
    const double step = (h_j_kg - h.value) / h.by_temperature;
    t += step;
    if (std::abs(step) < 1e-9 * std::abs(t)) break;  // quadratic: the error left is 1e-15 or less
  }
  return t;
}

double temperature_from_entropy(double phi_j_kgk, double f, double guess_k) {
  require_finite(phi_j_kgk, "entropy function");
  // Newton in ln T, in which phi is nearly straight: d(phi)/d(ln T) = cp
  double t = guess_k;
  for (int i = 0; i < 30; ++i) {
    const GasProperty phi = entropy_property(t, f);
    const double step = std::clamp((phi_j_kgk - phi.value) / (phi.by_temperature * t), -1.0, 1.0);
    t *= std::exp(step);
    if (std::abs(step) < 1e-9) break;
  }
  return t;
}

}  // namespace ehm::engine
