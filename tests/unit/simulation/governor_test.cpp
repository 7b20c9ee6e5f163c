#include "engine_sim/control/fuel_governor.h"

#include <gtest/gtest.h>

namespace {

using namespace ehm::engine;

constexpr double n1_rpm = 3650.0, fuel_kg_s = 0.82, dt_s = 0.015;

TEST(FuelGovernor, HoldsTheFuelInBalance) {
  FuelGovernor governor({}, n1_rpm, fuel_kg_s);
  for (int k = 0; k < 100; ++k) EXPECT_DOUBLE_EQ(governor.update(n1_rpm, n1_rpm, dt_s), fuel_kg_s);
}

TEST(FuelGovernor, StaysInsideSlewAndRange) {
  const GovernorOptions options;
  FuelGovernor governor(options, n1_rpm, fuel_kg_s);
  double last = fuel_kg_s;
  for (int k = 0; k < 2000; ++k) {
    const double fuel = governor.update(2.0 * n1_rpm, n1_rpm, dt_s);
    EXPECT_LE(fuel - last, options.slew_per_s * fuel_kg_s * dt_s * (1 + 1e-12));
    last = fuel;
  }
  EXPECT_DOUBLE_EQ(last, options.fuel_max_of_trim * fuel_kg_s);
}

TEST(FuelGovernor, LeavesALimitAtOnceWhenTheErrorTurns) {
  FuelGovernor governor({}, n1_rpm, fuel_kg_s);
  for (int k = 0; k < 2000; ++k) governor.update(1.2 * n1_rpm, n1_rpm, dt_s);
  const double at_limit = governor.update(1.2 * n1_rpm, n1_rpm, dt_s);
  EXPECT_LT(governor.update(0.99 * n1_rpm, n1_rpm, dt_s), at_limit);
}

}  // namespace
