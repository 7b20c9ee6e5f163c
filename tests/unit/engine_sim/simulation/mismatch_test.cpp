// SPDX-License-Identifier: Apache-2.0
// The causes of mismatch: what each does, how they are drawn, and that the flight reports what it should.

#include "engine_sim/mismatch/mismatch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/solve/steady.h"
#include "tests/unit/engine_sim/simulation/quiet_flight.h"

namespace ehm::engine_sim {
namespace {

using Draw = MismatchDraw;

std::size_t cause(std::string_view name) {
  for (std::size_t i = 0; i < mismatch_count; ++i)
    if (mismatch_causes()[i].name == name) return i;
  ADD_FAILURE() << name;
  return 0;
}

Mismatch only(std::string_view name, double value) {
  Mismatch one{};
  one[cause(name)] = value;
  return one;
}

/// Cruise of an engine that is so built.
GasPath cruise(const Mismatch& mismatch) {
  return solve_steady(Turbofan(built(jt9d(), mismatch)), {10668.0, 0.8, 0.0}, {}, {DemandKind::n1_rpm, 3600.0}).gas;
}

TEST(Mismatch, EveryCauseOfTheBuildIsSeenAndItsReverseSoToo) {
  const GasPath as_filed = cruise({});
  for (const MismatchCause& c : mismatch_causes()) {
    if (c.group != MismatchGroup::build || c.name == "lpt_cooling") continue;  // the JT9D's LPT is not cooled
    const auto change = [&](double value) {
      const GasPath g = cruise(only(c.name, value));
      // at constant fan speed another fuel changes its flow, everything else the temperatures
      return std::pair{g.fuel_flow_kg_s / as_filed.fuel_flow_kg_s - 1.0, g.s48.tt_k / as_filed.s48.tt_k - 1.0};
    };
    const auto [fuel_up, t48_up] = change(c.sigma);
    const auto [fuel_down, t48_down] = change(-c.sigma);
    EXPECT_GT(std::abs(fuel_up) + std::abs(t48_up), 1e-4) << c.name;
    EXPECT_NEAR(fuel_up, -fuel_down, 0.1 * std::abs(fuel_up) + 1e-6) << c.name;
    EXPECT_NEAR(t48_up, -t48_down, 0.1 * std::abs(t48_up) + 1e-6) << c.name;
  }
}

TEST(Mismatch, AHotterFuelNeedsLessOfItAndALargerCoreNozzleUnloadsTheTurbine) {
  const GasPath as_filed = cruise({});
  EXPECT_NEAR(cruise(only("heating_value", 0.01)).fuel_flow_kg_s / as_filed.fuel_flow_kg_s, 1.0 / 1.01, 1e-3);
  EXPECT_GT(cruise(only("core_nozzle_area", 0.01)).s48.pt_pa / cruise(only("core_nozzle_area", 0.01)).s50.pt_pa,
            as_filed.s48.pt_pa / as_filed.s50.pt_pa);
}

TEST(Mismatch, IsDrawnBySeedAndAGroupAlikeWithAndWithoutTheOthers) {
  const Mismatch all = drawn_mismatch(Draw{true, true, true}, 5);
  EXPECT_EQ(all, drawn_mismatch(Draw{true, true, true}, 5));
  EXPECT_NE(all, drawn_mismatch(Draw{true, true, true}, 6));
  EXPECT_EQ(drawn_mismatch({}, 5), Mismatch{});
  const Mismatch inputs = drawn_mismatch({.inputs = true}, 5);
  for (std::size_t i = 0; i < mismatch_count; ++i)
    EXPECT_EQ(inputs[i], mismatch_causes()[i].group == MismatchGroup::inputs ? all[i] : 0.0) << i;
}

TEST(Mismatch, HasTheSpreadThatItStates) {
  constexpr int fleet = 4000;
  Mismatch square{}, largest{};
  for (int k = 0; k < fleet; ++k) {
    const Mismatch one = drawn_mismatch(Draw{true, true, true}, static_cast<std::uint64_t>(k));
    for (std::size_t i = 0; i < mismatch_count; ++i) {
      square[i] += one[i] * one[i] / fleet;
      largest[i] = std::max(largest[i], std::abs(one[i]));
    }
  }
  for (std::size_t i = 0; i < mismatch_count; ++i) {
    const MismatchCause& c = mismatch_causes()[i];
    // a normal deviate cut at 3 sigma has 0.9866 of its standard deviation; 4000 of them tell it to 1.1 %
    const double expected = c.group == MismatchGroup::metal ? 1.0 : 0.9866;
    EXPECT_NEAR(std::sqrt(square[i]) / c.sigma, expected, 0.045) << c.name;
    EXPECT_LE(largest[i], 3.0 * c.sigma) << c.name;
  }
}

TEST(Mismatch, WhatIsReportedIsWrongByItsErrorsAndTheEngineFliesTheTruth) {
  Scenario right = test::quiet(), wrong = test::quiet();
  wrong.mismatch[cause("mach_error")] = 0.01;
  wrong.mismatch[cause("altitude_error")] = 50.0;
  wrong.mismatch[cause("air_temperature_error")] = -2.0;
  wrong.mismatch[cause("fuel_meter_error")] = 0.02;
  Simulation truth(right), misread(wrong);
  const SimSample a = test::fly(truth, 20), b = test::fly(misread, 20);
  EXPECT_NEAR(b.flight.mach - a.flight.mach, 0.01, 1e-12);
  EXPECT_NEAR(b.flight.altitude_m - a.flight.altitude_m, 50.0, 1e-9);
  EXPECT_NEAR(b.flight.delta_isa_k - a.flight.delta_isa_k, -2.0, 1e-12);
  EXPECT_NEAR(b.inputs.fuel_flow_kg_s / a.inputs.fuel_flow_kg_s, 1.02, 1e-12);
  EXPECT_EQ(b.actuation.fuel_flow_kg_s, a.actuation.fuel_flow_kg_s);
  for (std::size_t i = 0; i < a.readings.size(); ++i) EXPECT_EQ(b.readings[i].value, a.readings[i].value) << i;
}

TEST(Mismatch, TheTrimsOfTheDescriptionAreTheFilesNotTheBuilts) {
  Scenario scenario = test::quiet();
  scenario.mismatch = drawn_mismatch(Draw{true, true, true}, 3);
  const Simulation as_filed(test::quiet()), as_built(scenario);
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_EQ(as_built.channels().sensors[i].trim, as_filed.channels().sensors[i].trim) << i;
}

}  // namespace
}  // namespace ehm::engine_sim
