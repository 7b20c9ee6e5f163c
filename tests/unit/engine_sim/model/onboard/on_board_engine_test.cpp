// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/onboard/on_board_engine.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/solve/transient.h"
#include "tests/unit/engine_sim/model/onboard/operating_points.h"
#include "tests/unit/engine_sim/model/throttle_slam.h"

namespace ehm::engine_sim {
namespace {

void expect_same(const GasPath& a, const GasPath& b) {
  const auto x = quantities_of(a), y = quantities_of(b), size = sizes_of(b);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], y[i], 1e-9 * size[i]) << gas_path_quantity::names[i];
}

TEST(OnBoardEngine, HasTheValuesOfTheGasPathFromOnePointToTheNext) {
  const Turbofan engine(jt9d());
  OperatingPoints points(engine, 11);
  OnBoardEngine board(engine);
  GasPathJacobian jacobian;
  for (int i = 0; i < 60; ++i) {
    const OperatingPoint p = points.next();
    const MetalTemperatures* metal = i % 2 == 0 ? &p.metal : nullptr;
    FlowUnknowns unknowns = p.steady;
    const GasPath alone = engine.gas_path(p.operation, p.speeds, unknowns, metal);
    GasPath gas, with_derivatives;
    ASSERT_EQ(board.evaluate(p.operation, p.speeds, gas, metal), GasPathStatus::ok) << "point " << i;
    expect_same(gas, alone);
    ASSERT_EQ(board.evaluate(p.operation, p.speeds, with_derivatives, jacobian, metal), GasPathStatus::ok);
    expect_same(with_derivatives, alone);
  }
}

TEST(OnBoardEngine, StartsFromTheDesignPointAlmostAnywhereInTheEnvelope) {
  const Turbofan engine(jt9d());
  OperatingPoints points(engine, 12);
  int failures = 0;
  for (int i = 0; i < 1000; ++i) {
    const OperatingPoint p = points.next();
    OnBoardEngine board(engine);
    GasPath gas;
    failures += board.evaluate(p.operation, p.speeds, gas) != GasPathStatus::ok;
  }
  EXPECT_LE(failures, 3);  // at idle, far out of balance
}

TEST(OnBoardEngine, FollowsASlamWithHealthThatMoves) {
  const Turbofan engine(jt9d());
  envelope::Points random(13);
  for (const FlightCondition& flight : slam_flights) {
    const ThrottleSlam slam(engine, flight, 1.0);
    Transient run(engine, slam.idle(), HeatSoak::with);
    OnBoardEngine board(engine);
    board.start(slam.idle().unknowns);
    GasPathJacobian jacobian;
    for (int k = 0; k < 700; ++k) {
      Operation operation = slam.at(0.015 * k);
      run.step(operation, 0.015);
      for (double& h : operation.health) h = random.uniform(-1e-3, 1e-3);
      GasPath gas;
      const GasPathStatus status = k % 20 == 0 ? board.evaluate(operation, run.speeds(), gas, jacobian, &run.metal_k())
                                               : board.evaluate(operation, run.speeds(), gas, &run.metal_k());
      ASSERT_EQ(status, GasPathStatus::ok) << "step " << k;
      if (k % 10 != 0) continue;
      FlowUnknowns alone = slam.idle().unknowns;
      expect_same(gas, engine.gas_path(operation, run.speeds(), alone, &run.metal_k()));
    }
  }
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

struct Hostile {
  const char* what;
  void (*spoil)(OperatingPoint&);
  GasPathStatus status;
};

const std::vector<Hostile> hostile_inputs{
    {"altitude", [](OperatingPoint& p) { p.operation.flight.altitude_m = 1e300; }, GasPathStatus::outside_flight},
    {"Mach number", [](OperatingPoint& p) { p.operation.flight.mach = -0.1; }, GasPathStatus::outside_flight},
    {"ISA offset", [](OperatingPoint& p) { p.operation.flight.delta_isa_k = 61.0; }, GasPathStatus::outside_flight},
    {"Mach number NaN", [](OperatingPoint& p) { p.operation.flight.mach = nan; }, GasPathStatus::not_finite},
    {"negative N1", [](OperatingPoint& p) { p.speeds.n1_rpm = -3000.0; }, GasPathStatus::outside_speeds},
    {"N2 at rest", [](OperatingPoint& p) { p.speeds.n2_rpm = 0.0; }, GasPathStatus::outside_speeds},
    {"N2 NaN", [](OperatingPoint& p) { p.speeds.n2_rpm = nan; }, GasPathStatus::not_finite},
    {"N1 huge", [](OperatingPoint& p) { p.speeds.n1_rpm = 1e300; }, GasPathStatus::no_solution},
    {"N1 tiny", [](OperatingPoint& p) { p.speeds.n1_rpm = 1e-300; }, GasPathStatus::no_solution},
    {"no fuel", [](OperatingPoint& p) { p.operation.fuel_flow_kg_s = 0.0; }, GasPathStatus::outside_fuel},
    {"fuel infinite", [](OperatingPoint& p) { p.operation.fuel_flow_kg_s = inf; }, GasPathStatus::not_finite},
    {"fuel huge", [](OperatingPoint& p) { p.operation.fuel_flow_kg_s = 1e300; }, GasPathStatus::no_solution},
    {"ten times the fuel", [](OperatingPoint& p) { p.operation.fuel_flow_kg_s *= 10.0; }, GasPathStatus::no_solution},
    {"health", [](OperatingPoint& p) { p.operation.health[hpc_flow] = -0.9; }, GasPathStatus::outside_health},
    {"health NaN", [](OperatingPoint& p) { p.operation.health[fan_flow] = nan; }, GasPathStatus::not_finite},
    {"vanes", [](OperatingPoint& p) { p.operation.geometry.vsv_deg = 90.0; }, GasPathStatus::outside_controls},
    {"bleed valves", [](OperatingPoint& p) { p.operation.geometry.vbv_fraction = -0.1; },
     GasPathStatus::outside_controls},
    {"off-take", [](OperatingPoint& p) { p.operation.offtake.power_w = 1e8; }, GasPathStatus::outside_controls},
    {"metal NaN", [](OperatingPoint& p) { p.metal[hpt_metal] = nan; }, GasPathStatus::not_finite},
    {"metal huge", [](OperatingPoint& p) { p.metal[hpc_metal] = 1e300; }, GasPathStatus::no_solution}};

TEST(OnBoardEngine, TellsByItsStatusWhatHasNoAnswerAndRecoversAtTheNextGoodCall) {
  const Turbofan engine(jt9d());
  const OperatingPoint good = OperatingPoints(engine, 14).next();
  OnBoardEngine board(engine);
  GasPath reference;
  GasPathJacobian slopes;
  ASSERT_EQ(board.evaluate(good.operation, good.speeds, reference, slopes, &good.metal), GasPathStatus::ok);
  for (const Hostile& h : hostile_inputs) {
    SCOPED_TRACE(h.what);
    OperatingPoint bad = good;
    h.spoil(bad);
    GasPath kept = reference;
    GasPathJacobian kept_slopes = slopes;
    EXPECT_EQ(board.evaluate(bad.operation, bad.speeds, kept, &bad.metal), h.status);
    EXPECT_EQ(board.evaluate(bad.operation, bad.speeds, kept, kept_slopes, &bad.metal), h.status);
    EXPECT_EQ(quantities_of(kept), quantities_of(reference));
    EXPECT_EQ(kept_slopes, slopes);
    GasPath again;
    ASSERT_EQ(board.evaluate(good.operation, good.speeds, again, &good.metal), GasPathStatus::ok);
    expect_same(again, reference);
  }
}

TEST(OnBoardEngine, AnyNumberAnywhereGivesAStatusAndFiniteResults) {
  const Turbofan engine(jt9d());
  OperatingPoints points(engine, 15);
  envelope::Points random(16);
  const std::vector<double> odd{nan, inf, -inf, 1e300, -1e300, 1e-300, 0.0, -1.0, 1e6, -0.4, 0.4};
  OnBoardEngine board(engine);
  for (int i = 0; i < 400; ++i) {
    const OperatingPoint good = points.next();
    auto p = inputs_of(good.operation, good.speeds, &good.metal);
    for (int k = 0; k < 1 + i % 3; ++k) {
      p[static_cast<std::size_t>(random.uniform(0.0, gas_path_input::count))] =
          odd[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(odd.size())))];
    }
    const auto drive = drive_of(good.operation, p);
    GasPath gas;
    GasPathJacobian jacobian;
    if (board.evaluate(drive.operation, drive.speeds, gas, jacobian, &drive.metal) == GasPathStatus::ok) {
      EXPECT_TRUE(jacobian.allFinite());
    }
    ASSERT_EQ(board.evaluate(good.operation, good.speeds, gas, &good.metal), GasPathStatus::ok) << "point " << i;
  }
}

TEST(OnBoardEngine, ASenselessStartIsReplacedByTheDesignPoint) {
  const Turbofan engine(jt9d());
  const OperatingPoint good = OperatingPoints(engine, 17).next();
  OnBoardEngine board(engine);
  board.start({{nan, nan, nan, nan, nan, nan}});
  GasPath gas;
  EXPECT_EQ(board.evaluate(good.operation, good.speeds, gas), GasPathStatus::ok);
  board.start({{1e300, -5.0, 0.0, 1e-300, 1.0, 0.0}});
  EXPECT_EQ(board.evaluate(good.operation, good.speeds, gas), GasPathStatus::ok);
}

}  // namespace
}  // namespace ehm::engine_sim
