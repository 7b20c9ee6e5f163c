// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/thermo/gas.h"

#include <gtest/gtest.h>

#include <limits>

namespace ehm::engine_sim {
namespace {

// Keenan, Chao & Kaye, Gas Tables (ideal-gas air), as tabulated in Moran & Shapiro, table A-22: T, h kJ/kg, s0 kJ/kgK.
struct AirRow {
  double t_k, h_kj_kg, s0_kj_kgk;
};
constexpr AirRow air_table[] = {{300.0, 300.19, 1.70203},
                                {500.0, 503.02, 2.21952},
                                {800.0, 821.95, 2.71787},
                                {1000.0, 1046.04, 2.96770},
                                {1500.0, 1635.97, 3.44516}};

TEST(Gas, EnthalpyAndEntropyOfAirAgreeWithTheGasTables) {
  const double h300 = enthalpy(300.0, 0.0), phi300 = entropy_function(300.0, 0.0);
  for (const AirRow& row : air_table) {
    // differences from 300 K: the zero of the scale is a convention; 0.25 % is the spread between published tables
    const double h_table = 1e3 * (row.h_kj_kg - air_table[0].h_kj_kg);
    const double s_table = 1e3 * (row.s0_kj_kgk - air_table[0].s0_kj_kgk);
    EXPECT_NEAR(enthalpy(row.t_k, 0.0) - h300, h_table, 2.5e-3 * h_table) << row.t_k;
    EXPECT_NEAR(entropy_function(row.t_k, 0.0) - phi300, s_table, 2.5e-3 * s_table) << row.t_k;
  }
}

TEST(Gas, DerivativesAreThoseOfTheFunctions) {
  for (const double t : {150.0, 250.0, 700.0, 1500.0, 1990.0, 2300.0}) {
    const GasProperty h = enthalpy_property(t, 0.02), phi = entropy_property(t, 0.02);
    const double dt = 1e-2, df = 1e-5;
    EXPECT_NEAR(h.by_temperature, (enthalpy(t + dt, 0.02) - enthalpy(t - dt, 0.02)) / (2 * dt), 1e-4);
    EXPECT_NEAR(phi.by_temperature, (entropy_function(t + dt, 0.02) - entropy_function(t - dt, 0.02)) / (2 * dt), 1e-6);
    EXPECT_NEAR(h.by_fuel_air_ratio, (enthalpy(t, 0.02 + df) - enthalpy(t, 0.02 - df)) / (2 * df), 1.0);
    EXPECT_NEAR(phi.by_fuel_air_ratio, (entropy_function(t, 0.02 + df) - entropy_function(t, 0.02 - df)) / (2 * df),
                1e-3);
  }
}

TEST(Gas, InversionsCloseTheCircle) {
  for (double t = 180.0; t < 2200.0; t += 60.0) {
    for (const double f : {0.0, 0.02, 0.045}) {
      EXPECT_NEAR(temperature_from_enthalpy(enthalpy(t, f), f, 600.0).t_k, t, 1e-12 * t);
      const double log_pressure_ratio = (entropy_function(t, f) - entropy_function(600.0, f)) / gas_constant(f);
      EXPECT_NEAR(isentropic_temperature(600.0, f, log_pressure_ratio), t, 1e-12 * t);
    }
  }
}

TEST(Gas, DerivativesOfTheInversionsAreThoseOfDifferences) {
  const double f = 0.02, df = 1e-5, dt = 1e-2, dx = 1e-4;
  // relative by f: the change of R with f is left out of the derivative
  for (const double t : {150.0, 300.0, 800.0, 1700.0, 2300.0}) {
    const double h = enthalpy(t, f), dh = 10.0;
    const auto temperature = [](double at_h, double at_f) { return temperature_from_enthalpy(at_h, at_f, 700.0).t_k; };
    const GasTemperature inverse = temperature_from_enthalpy(h, f, 700.0);
    EXPECT_NEAR(inverse.by_target, (temperature(h + dh, f) - temperature(h - dh, f)) / (2 * dh), 1e-9);
    EXPECT_NEAR(inverse.by_fuel_air_ratio, (temperature(h, f + df) - temperature(h, f - df)) / (2 * df), 2e-3);
    for (const double x : {-1.5, 0.4, 1.5}) {
      const IsentropicTemperature at = isentropic_change(t, f, x);
      EXPECT_NEAR(at.by_temperature,
                  (isentropic_change(t + dt, f, x).t_k - isentropic_change(t - dt, f, x).t_k) / (2 * dt), 1e-6);
      EXPECT_NEAR(at.by_fuel_air_ratio,
                  (isentropic_change(t, f + df, x).t_k - isentropic_change(t, f - df, x).t_k) / (2 * df),
                  1e-4 * std::abs(at.by_fuel_air_ratio));
      EXPECT_NEAR(at.by_log_pressure_ratio,
                  (isentropic_change(t, f, x + dx).t_k - isentropic_change(t, f, x - dx).t_k) / (2 * dx), 1e-3);
    }
  }
}

TEST(Gas, IsentropicCompressionOfColdAirFollowsConstantGamma) {
  // at 220 K gamma is 1.401: T2/T1 = 2^(R/cp), R/cp = 287.05/1003.0 = 0.2862
  EXPECT_NEAR(isentropic_temperature(220.0, 0.0, std::log(2.0)) / 220.0, std::pow(2.0, 0.2862), 3e-4);
}

TEST(Gas, RefusesATargetThatIsNotFinite) {
  EXPECT_TRUE(std::isnan(temperature_from_enthalpy(std::numeric_limits<double>::quiet_NaN(), 0.0, 300.0).t_k));
  EXPECT_TRUE(std::isnan(isentropic_temperature(300.0, 0.0, std::numeric_limits<double>::infinity())));
}

}  // namespace
}  // namespace ehm::engine_sim
