// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/solve/transient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "engine_sim/engines/jt9d.h"
#include "tests/unit/engine_sim/model/throttle_slam.h"

namespace ehm::engine_sim {
namespace {

constexpr FlightCondition cruise{10668.0, 0.8, 0.0};

/// Fuel steps of 8 % down and up again within 4 s; returns N1, N2, T40 every 0.3 s.
std::vector<double> fuel_steps(const Turbofan& engine, const SteadyPoint& start, int steps_per_15_ms) {
  Transient run(engine, start);
  Operation operation = start.operation;
  std::vector<double> history;
  for (int k = 0; k < 267; ++k) {
    const double t_s = 0.015 * k;
    operation.fuel_flow_kg_s = start.operation.fuel_flow_kg_s * (t_s >= 0.3 && t_s < 2.1 ? 0.92 : 1.0);
    if (k % 20 == 0) {
      const GasPath g = run.output(operation);
      history.insert(history.end(), {g.speeds.n1_rpm, g.speeds.n2_rpm, g.s40.tt_k});
    }
    for (int i = 0; i < steps_per_15_ms; ++i) run.step(operation, 0.015 / steps_per_15_ms);
  }
  return history;
}

TEST(Transient, StaysAtASteadyPointAndReturnsToIt) {
  const Turbofan engine(jt9d());
  const SteadyPoint start = solve_steady(engine, cruise, {}, {DemandKind::n1_rpm, 3400.0});
  Transient run(engine, start);
  for (int k = 0; k < 100; ++k) run.step(start.operation, 0.015);
  EXPECT_NEAR(run.speeds().n1_rpm, start.gas.speeds.n1_rpm, 1e-6);
  Operation more = start.operation;
  more.fuel_flow_kg_s *= 1.03;
  for (int k = 0; k < 200; ++k) run.step(more, 0.015);
  EXPECT_GT(run.speeds().n1_rpm, start.gas.speeds.n1_rpm + 10.0);
  for (int k = 0; k < 2000; ++k) run.step(start.operation, 0.015);
  EXPECT_NEAR(run.speeds().n1_rpm, start.gas.speeds.n1_rpm, 1e-6 * start.gas.speeds.n1_rpm);
  EXPECT_NEAR(run.speeds().n2_rpm, start.gas.speeds.n2_rpm, 1e-6 * start.gas.speeds.n2_rpm);
}

TEST(Transient, FifteenMillisecondsAgreeWithOneMillisecond) {
  const Turbofan engine(jt9d());
  const SteadyPoint start = solve_steady(engine, cruise, {}, {DemandKind::n1_rpm, 3500.0});
  const std::vector<double> coarse = fuel_steps(engine, start, 1), fine = fuel_steps(engine, start, 15);
  double worst = 0.0;
  for (std::size_t i = 0; i < fine.size(); ++i) worst = std::max(worst, std::abs(coarse[i] / fine[i] - 1.0));
  std::printf("15 ms against 1 ms: largest difference %.5f %% of N1, N2, T40\n", 100.0 * worst);
  EXPECT_LT(worst, 1e-3);
}

// Balances close to 1e-10 from either guess.
TEST(Transient, ARestlessFlightDiffersByItsGuessesOnly) {
  const Turbofan engine(jt9d());
  const SteadyPoint start = solve_steady(engine, cruise, {}, {DemandKind::n1_rpm, 3400.0});
  Transient smooth(engine, start), restless(engine, start, HeatSoak::without, Motion::restless);
  Operation operation = start.operation;
  for (int k = 0; k < 100; ++k) {
    operation.fuel_flow_kg_s = start.operation.fuel_flow_kg_s * (1.0 + 0.0005 * k);
    smooth.step(operation, 0.015), restless.step(operation, 0.015);
  }
  EXPECT_NEAR(restless.speeds().n1_rpm, smooth.speeds().n1_rpm, 1e-6);
  EXPECT_NEAR(restless.speeds().n2_rpm, smooth.speeds().n2_rpm, 1e-6);
}

TEST(Transient, ADisturbanceOfTheSpeedsIsInTheNextOutputAndDiesOut) {
  const Turbofan engine(jt9d());
  const SteadyPoint start = solve_steady(engine, cruise, {}, {DemandKind::n1_rpm, 3400.0});
  Transient run(engine, start);
  const double still_ps30 = run.output(start.operation).ps_30_pa;
  run.disturb({10.0, 30.0});
  EXPECT_EQ(run.speeds().n1_rpm, start.gas.speeds.n1_rpm + 10.0);
  EXPECT_EQ(run.output(start.operation).speeds.n2_rpm, start.gas.speeds.n2_rpm + 30.0);
  EXPECT_NE(run.output(start.operation).ps_30_pa, still_ps30);
  for (int k = 0; k < 2000; ++k) run.step(start.operation, 0.015);
  EXPECT_NEAR(run.speeds().n2_rpm, start.gas.speeds.n2_rpm, 1e-6 * start.gas.speeds.n2_rpm);
}

/// N1, N2, T40, P30 every 15 ms of one slam.
std::vector<double> slam_history(const Turbofan& engine, const ThrottleSlam& slam, int steps_per_15_ms) {
  Transient run(engine, slam.idle());
  std::vector<double> history;
  for (double t_s = 0.0; t_s < ThrottleSlam::period_s; t_s += 0.015) {
    const Operation operation = slam.at(t_s);
    const GasPath& g = run.output(operation);
    history.insert(history.end(), {g.speeds.n1_rpm, g.speeds.n2_rpm, g.s40.tt_k, g.s30.pt_pa});
    for (int i = 0; i < steps_per_15_ms; ++i) run.step(operation, 0.015 / steps_per_15_ms);
  }
  return history;
}

TEST(Transient, ThrottleSlamsAgreeWithOneMillisecond) {
  const Turbofan engine(jt9d());
  for (const FlightCondition& flight : slam_flights) {
    for (const double ramp_s : slam_ramps_s) {
      const ThrottleSlam slam(engine, flight, ramp_s);
      const std::vector<double> coarse = slam_history(engine, slam, 1), fine = slam_history(engine, slam, 15);
      double worst = 0.0;
      for (std::size_t i = 0; i < fine.size(); ++i) worst = std::max(worst, std::abs(coarse[i] / fine[i] - 1.0));
      std::printf("slam within %.1f s at %.0f m: 15 ms against 1 ms %.4f %% of N1, N2, T40, P30\n", ramp_s,
                  flight.altitude_m, 100.0 * worst);
      EXPECT_LT(worst, 1e-3) << flight.altitude_m << " m, ramp " << ramp_s << " s";
      // it did go all the way
      EXPECT_GT(*std::max_element(coarse.begin(), coarse.end()), 2.0 * slam.idle().gas.s30.pt_pa);
    }
  }
}

TEST(Transient, TheSameFlightGivesTheSameNumbers) {
  const Turbofan engine(jt9d());
  const ThrottleSlam slam(engine, high_cruise, 1.0);
  EXPECT_EQ(slam_history(engine, slam, 1), slam_history(engine, slam, 1));
}

TEST(Transient, OutputDoesNotChangeTheState) {
  const Turbofan engine(jt9d());
  const SteadyPoint start = solve_steady(engine, cruise, {}, {DemandKind::n1_rpm, 3400.0});
  Transient looked(engine, start), blind(engine, start);
  Operation more = start.operation;
  more.fuel_flow_kg_s *= 1.1;
  for (int k = 0; k < 50; ++k) {
    looked.output(start.operation);
    looked.output(more);
    looked.step(more, 0.015);
    blind.step(more, 0.015);
  }
  EXPECT_NEAR(looked.speeds().n1_rpm, blind.speeds().n1_rpm, 1e-6);
}

TEST(Transient, RefusesAStepOutOfRange) {
  const Turbofan engine(jt9d());
  Transient run(engine, solve_steady(engine, cruise, {}, {DemandKind::n1_rpm, 3400.0}));
  Operation operation{cruise, {}, 0.6};
  EXPECT_THROW(run.step(operation, 0.0), std::invalid_argument);
  EXPECT_THROW(run.step(operation, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::engine_sim
