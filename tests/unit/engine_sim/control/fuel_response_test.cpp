// SPDX-License-Identifier: Apache-2.0
// The gains and lags that the control's data state, against the linear model of the nonlinear engine.

#include <gtest/gtest.h>

#include <array>

#include "tests/unit/engine_sim/control/controlled_flight.h"

namespace {

using namespace ehm::engine_sim;
using namespace ehm::test;

/// d ln y/d ln Wf at rest, at once, and the lag (sum of the engine's lags less the lead), times delta2.
struct Response {
  double gain, at_once, lag_s_at_sea_level;
};
struct Responses {
  Response n1, n2, t48, ps_30;
};

/// Logarithmic derivatives at constant flight condition by central differences of a thousandth of a percent.
Responses linear_model(const FlightCondition& flight, double n1_corrected_rpm) {
  const Turbofan& engine = new_engine();
  const SteadyPoint p = solve_steady(engine, flight, {}, {DemandKind::n1_rpm, n1_corrected_rpm * root_theta2(flight)});
  constexpr double step = 1e-5;
  const auto gas = [&](std::array<double, 3> change) {  // of ln N1, ln N2, ln Wf
    Operation operation = p.operation;
    operation.fuel_flow_kg_s *= 1.0 + change[2];
    FlowUnknowns unknowns = p.unknowns;
    const SpoolSpeeds speeds{p.gas.speeds.n1_rpm * (1.0 + change[0]), p.gas.speeds.n2_rpm * (1.0 + change[1])};
    return engine.gas_path(operation, speeds, unknowns);
  };
  std::array<std::array<double, 3>, 4> d;  // rows: dn1/dt, dn2/dt, T48, Ps30; all relative
  for (std::size_t j = 0; j < 3; ++j) {
    std::array<double, 3> change{};
    change[j] = step;
    const GasPath up = gas(change);
    change[j] = -step;
    const GasPath down = gas(change);
    d[0][j] = (up.n1_dot_rpm_s - down.n1_dot_rpm_s) / (2.0 * step * p.gas.speeds.n1_rpm);
    d[1][j] = (up.n2_dot_rpm_s - down.n2_dot_rpm_s) / (2.0 * step * p.gas.speeds.n2_rpm);
    d[2][j] = (up.s48.tt_k - down.s48.tt_k) / (2.0 * step * p.gas.s48.tt_k);
    d[3][j] = (up.ps_30_pa - down.ps_30_pa) / (2.0 * step * p.gas.ps_30_pa);
  }
  const double determinant = d[0][0] * d[1][1] - d[0][1] * d[1][0];
  const double lags_s = -(d[0][0] + d[1][1]) / determinant;  // 1/p1 + 1/p2
  const std::array<double, 2> k{-(d[1][1] * d[0][2] - d[0][1] * d[1][2]) / determinant,
                                -(d[0][0] * d[1][2] - d[1][0] * d[0][2]) / determinant};
  const double delta2 = p.gas.s2.pt_pa / reference_pressure_pa;
  // speed i: k_i (1 + s/z)/((1 + s/p1)(1 + s/p2)), 1/z = b_i/(k_i p1 p2)
  const auto speed = [&](std::size_t i) {
    return Response{k[i], 0.0, delta2 * (lags_s - d[i][2] / (k[i] * determinant))};
  };
  const auto output = [&](std::size_t i) { return Response{d[i][2] + d[i][0] * k[0] + d[i][1] * k[1], d[i][2], 0.0}; };
  return {speed(0), speed(1), output(2), output(3)};
}

constexpr std::array<FlightCondition, 5> envelope{
    {{0, 0, 0}, {0, 0.45, 0}, {10668, 0.8, 0}, {13500, 0.9, -20}, {13500, 0.45, 0}}};

/// Half as much again either way: what the loops' phase margin of 90 degrees bears with ease.
void expect_of_this_size(double stated, double model, const char* what, double n1c) {
  EXPECT_GT(stated, model / 1.5) << what << " at " << n1c;
  EXPECT_LT(stated, model * 1.5) << what << " at " << n1c;
}

TEST(FuelResponse, SpeedsAnswerAsStated) {
  const FuelControlData f = jt9d_control().fuel;
  for (const FlightCondition& flight : envelope)
    for (const double n1c : {2200.0, 2800.0, 3200.0, 3600.0, 3900.0}) {
      const Responses r = linear_model(flight, n1c);
      expect_of_this_size(scheduled(f.n1_gain, n1c), r.n1.gain, "N1 gain", n1c);
      expect_of_this_size(scheduled(f.n1_lag_s, n1c), r.n1.lag_s_at_sea_level, "N1 lag", n1c);
      expect_of_this_size(scheduled(f.n2_gain, n1c), r.n2.gain, "N2 gain", n1c);
      expect_of_this_size(scheduled(f.n2_lag_s, n1c), r.n2.lag_s_at_sea_level, "N2 lag", n1c);
    }
}

TEST(FuelResponse, TemperatureAndPressureAnswerAsStated) {
  const FuelControlData f = jt9d_control().fuel;
  for (const FlightCondition& flight : envelope)
    for (const double n1c : {3600.0, 3900.0}) {  // their limits lie at high power
      const Responses r = linear_model(flight, n1c);
      expect_of_this_size(f.t48.gain, r.t48.at_once, "T48 gain", n1c);
      expect_of_this_size(f.ps_30.gain, r.ps_30.gain, "Ps30 gain", n1c);
      EXPECT_GT(r.t48.gain, 0.0);
      EXPECT_LT(r.t48.gain, r.t48.at_once);  // more speed, more air: the integral loop does not overshoot
    }
}

}  // namespace
