// SPDX-License-Identifier: Apache-2.0
// The selection of loops on made-up measurements: no engine answers, so every step is the control's own.

#include "engine_sim/control/fuel_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine_sim/control/engine_control.h"
#include "engine_sim/engines/jt9d_control.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"

namespace {

using namespace ehm::engine_sim;

constexpr double dt_s = 0.015, fuel_kg_s = 1.5;
/// Sea level static, 82 % of fan speed; ratio units 1.0.
constexpr Measurements middle{3200.0, 7467.0, 1000.0, fuel_kg_s * 1e6, 288.15, 101325.0};

FuelControl start(const ControlData& data = jt9d_control()) {
  return {data, middle, fuel_kg_s};
}

TEST(FuelControl, HoldsTheFuelInBalance) {
  FuelControl control = start();
  for (int k = 0; k < 100; ++k) EXPECT_DOUBLE_EQ(control.update(middle, middle.n1_rpm, dt_s), fuel_kg_s);
  EXPECT_EQ(control.active(), FuelLoop::n1_governor);
}

TEST(FuelControl, StaysInsideSlewAndSchedules) {
  const FuelControlData f = jt9d_control().fuel;
  FuelControl control = start();
  double last = fuel_kg_s;
  const auto fly = [&](double n1_demand_rpm) {
    for (int k = 0; k < 400; ++k) {
      const double fuel = control.update(middle, n1_demand_rpm, dt_s);
      EXPECT_LE(std::abs(std::log(fuel / last)), f.slew_per_s * dt_s * (1 + 1e-12));
      last = fuel;
    }
    return last / fuel_per_ratio_unit(middle, f.theta_exponent);
  };
  EXPECT_NEAR(fly(4000.0), scheduled(f.acceleration, middle.n2_corrected_rpm()), 1e-12);
  EXPECT_EQ(control.active(), FuelLoop::acceleration);
  EXPECT_NEAR(fly(1000.0), scheduled(f.deceleration, middle.n2_corrected_rpm()), 1e-12);
  EXPECT_EQ(control.active(), FuelLoop::deceleration);
}

TEST(FuelControl, NothingWindsUpAtALimit) {
  FuelControl control = start();
  for (int k = 0; k < 4000; ++k) control.update(middle, 4000.0, dt_s);  // a minute against the schedule
  const double at_schedule = control.fuel_flow_kg_s();
  EXPECT_LT(control.update(middle, 0.999 * middle.n1_rpm, dt_s), at_schedule);  // the first step goes back already

  Measurements hot = middle;
  hot.t48_k = jt9d_control().limits.t48_k;  // exactly at its limit: nothing moves, whatever is demanded
  FuelControl held = start();
  for (int k = 0; k < 4000; ++k) held.update(hot, 4000.0, dt_s);
  EXPECT_EQ(held.active(), FuelLoop::t48_limit);
  EXPECT_NEAR(held.fuel_flow_kg_s(), fuel_kg_s, 0.2 * fuel_kg_s);
  const double at_limit = held.fuel_flow_kg_s();
  EXPECT_GT(held.update(middle, 4000.0, dt_s), at_limit);  // the reason goes: more fuel in the same step
}

TEST(FuelControl, ALimitWinsOverTheDemandAndIdleOverLess) {
  const EngineLimits limit = jt9d_control().limits;
  const auto active_at = [](const Measurements& m, double n1_demand_rpm) {
    FuelControl control = {jt9d_control(), m, 1e-6 * m.ps_30_pa * 0.85};
    control.update(m, n1_demand_rpm, dt_s);
    return control.active();
  };
  Measurements m = middle;
  m.n1_rpm = limit.n1_rpm;
  EXPECT_EQ(active_at(m, 4500.0), FuelLoop::n1_limit);
  m.t48_k = 1.001 * limit.t48_k;
  EXPECT_EQ(active_at(m, m.n1_rpm), FuelLoop::t48_limit);
  m = middle;
  m.ps_30_pa = 1.001 * limit.ps_30_pa;
  EXPECT_EQ(active_at(m, m.n1_rpm), FuelLoop::ps_30_limit);
  m = middle;
  m.n2_rpm = 1.001 * limit.n2_rpm;
  EXPECT_EQ(active_at(m, m.n1_rpm), FuelLoop::n2_limit);
  m = middle;
  m.n2_rpm = 0.999 * limit.flight_idle_n2_corrected_rpm;
  m.ps_30_pa = 0.5e6;
  EXPECT_EQ(active_at(m, m.n1_rpm), FuelLoop::n2_idle);
}

TEST(FuelControl, LimitsCanBeSwitchedOff) {
  ControlData free = jt9d_control();
  free.hold_limits = false;
  Measurements hot = middle;
  hot.t48_k = 1.2 * free.limits.t48_k;
  FuelControl control = {free, hot, fuel_kg_s};
  EXPECT_DOUBLE_EQ(control.update(hot, hot.n1_rpm, dt_s), fuel_kg_s);
  EXPECT_LT(start().update(hot, hot.n1_rpm, dt_s), fuel_kg_s);
}

TEST(Allocation, NoneInTheControl) {
  EngineControl control(jt9d_control(), middle, fuel_kg_s);
  const long before = ehm::test::allocation_count();
  for (int k = 0; k < 400; ++k) control.update(middle, k % 2 ? 4000.0 : 1000.0, dt_s);
  EXPECT_EQ(ehm::test::allocation_count(), before);
}

}  // namespace
