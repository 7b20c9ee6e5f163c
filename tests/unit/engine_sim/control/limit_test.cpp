// SPDX-License-Identifier: Apache-2.0
// Each limit on the nonlinear engine: reached, held, and passed by less than stated.

#include <gtest/gtest.h>

#include <cstdio>

#include "engine_sim/model/ratings.h"
#include "tests/unit/engine_sim/control/controlled_flight.h"

namespace {

using namespace ehm::engine_sim;
using namespace ehm::test;

struct LimitCase {
  const char* name;
  FlightCondition flight;
  FuelLoop loop;
  double EngineLimits::*limit;
  double limit_value;
  double (*of)(const GasPath&);
  double overshoot;
};

class Limit : public testing::TestWithParam<LimitCase> {};

TEST_P(Limit, IsReachedAndHeld) {
  const LimitCase& c = GetParam();
  ControlData data = jt9d_control();
  data.limits.*c.limit = c.limit_value;
  ControlledFlight run(c.flight, 2400.0 * root_theta2(c.flight), data);
  double most = 0.0;
  const ControlledSample last =
      run.fly(4900.0, 30.0, [&](const ControlledSample& s, double) { most = std::max(most, c.of(s.gas)); });
  std::printf("%-5s overshoot %.3f %%\n", c.name, 100.0 * (most / c.limit_value - 1.0));
  EXPECT_EQ(last.actuation.active, c.loop);
  EXPECT_NEAR(c.of(last.gas), c.limit_value, 1e-3 * c.limit_value);
  EXPECT_LT(most, (1.0 + c.overshoot) * c.limit_value);
}

INSTANTIATE_TEST_SUITE_P(Control, Limit,
                         testing::Values(LimitCase{"N1",
                                                   {6000.0, 0.6, 35.0},
                                                   FuelLoop::n1_limit,
                                                   &EngineLimits::n1_rpm,
                                                   3700.0,
                                                   [](const GasPath& g) { return g.speeds.n1_rpm; },
                                                   0.005},
                                         LimitCase{"N2", sea_level, FuelLoop::n2_limit, &EngineLimits::n2_rpm, 7600.0,
                                                   [](const GasPath& g) { return g.speeds.n2_rpm; }, 0.005},
                                         LimitCase{"T48",
                                                   {0.0, 0.2, 35.0},
                                                   FuelLoop::t48_limit,
                                                   &EngineLimits::t48_k,
                                                   1233.0,
                                                   [](const GasPath& g) { return g.s48.tt_k; },
                                                   0.01},
                                         LimitCase{"Ps30",
                                                   {0.0, 0.4, -20.0},
                                                   FuelLoop::ps_30_limit,
                                                   &EngineLimits::ps_30_pa,
                                                   2.2e6,
                                                   [](const GasPath& g) { return g.ps_30_pa; },
                                                   0.01}),
                         [](const auto& one) { return one.param.name; });

TEST(Idle, IsHeldEverywhereWhateverLittleIsDemanded) {
  for (const FlightCondition& flight : {sea_level, cruise, ceiling, FlightCondition{13500.0, 0.5, -20.0}}) {
    ControlledFlight run(flight, 3600.0 * root_theta2(flight));
    const double idle_rpm = jt9d_control().limits.idle_n2_corrected_rpm(on_ground(flight));
    double least = 1e9;
    const ControlledSample last = run.fly(500.0, 60.0, [&](const ControlledSample& s, double) {
      least = std::min(least, measure(s.gas).n2_corrected_rpm());
    });
    EXPECT_EQ(last.actuation.active, FuelLoop::n2_idle);
    EXPECT_NEAR(measure(last.gas).n2_corrected_rpm(), idle_rpm, 1e-3 * idle_rpm);
    EXPECT_GT(least, 0.995 * idle_rpm);
  }
}

TEST(Idle, AFlightMayStartBeyondEitherEnd) {
  const ControlData data = jt9d_control();
  for (const double n1_rpm : {0.0, 500.0, 4900.0}) {
    const Measurements m = measure(settled(new_engine(), data, {cruise, {}, {}}, n1_rpm).gas);
    EXPECT_GT(m.n2_corrected_rpm(), 0.999 * data.limits.flight_idle_n2_corrected_rpm);
    EXPECT_LT(m.n1_rpm, 1.001 * data.limits.n1_rpm);
    EXPECT_LT(m.n1_corrected_rpm(), 1.001 * data.limits.n1_corrected_rpm);
  }
}

}  // namespace
