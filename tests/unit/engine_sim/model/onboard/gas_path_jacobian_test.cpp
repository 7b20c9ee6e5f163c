// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/onboard/gas_path_jacobian.h"

#include <gtest/gtest.h>

#include <set>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/jt9d.h"
#include "tests/unit/engine_sim/model/onboard/operating_points.h"
#include "tests/unit/engine_sim/model/throttle_slam.h"

namespace ehm::engine_sim {
namespace {

using gas_path_input::name, gas_path_quantity::names, gas_path_quantity::place;
using Column = Eigen::Array<double, static_cast<int>(gas_path_quantity::count), 1>;

Column column(const GasPathQuantities<double>& y) {
  return Column::Map(y.data());
}

/// Values by the throwing gas path at inputs that are moved.
class Moved {
 public:
  Moved(const Turbofan& engine, const OperatingPoint& at, const FlowUnknowns& solved)
      : engine_(engine), at_(at), solved_(solved) {}

  Column by(std::size_t input, double step) const {
    auto p = inputs_of(at_.operation, at_.speeds, &at_.metal);
    p[input] += step;
    const auto drive = drive_of(at_.operation, p);
    FlowUnknowns unknowns = solved_;
    return column(quantities_of(engine_.gas_path(drive.operation, drive.speeds, unknowns, &drive.metal)));
  }
  /// Central differences of fourth order.
  Column slope(std::size_t input, double h) const {
    return (8.0 * (by(input, 0.5 * h) - by(input, -0.5 * h)) - (by(input, h) - by(input, -h))) / (6.0 * h);
  }
  /// What counts as a step of one.
  double size(std::size_t input) const {
    if (input >= gas_path_input::first_health) return 1.0;
    return input == gas_path_input::vsv   ? 10.0
           : input == gas_path_input::vbv ? 1.0
                                          : inputs_of(at_.operation, at_.speeds, &at_.metal)[input];
  }

 private:
  const Turbofan& engine_;
  const OperatingPoint& at_;
  const FlowUnknowns& solved_;
};

/// The maps are splines with knots: what one step of the differences hits, another misses.
Column error(const Column& exact, const Moved& moved, std::size_t input, const Column& sizes) {
  Column least = Column::Constant(1.0);
  for (const double step : {2e-4, 5e-5, 2e-5}) {
    const Column differences = moved.slope(input, step * moved.size(input));
    const Column scale = differences.abs().max(sizes / moved.size(input));
    least = least.min((exact - differences).abs() / scale);
  }
  return least;
}

TEST(GasPathJacobian, IsThatOfCentralDifferencesOverTheEnvelope) {
  const Turbofan engine(jt9d());
  OperatingPoints points(engine, 21);
  double worst = 0.0;
  for (int i = 0; i < 30; ++i) {
    const OperatingPoint p = points.next();
    OnBoardEngine board(engine);
    board.start(p.steady);
    GasPath gas;
    GasPathJacobian jacobian;
    ASSERT_EQ(board.evaluate(p.operation, p.speeds, gas, jacobian, &p.metal), GasPathStatus::ok);
    const Moved moved(engine, p, board.unknowns());
    for (std::size_t j = 0; j < gas_path_input::count; ++j) {
      const Column e = error(jacobian.col(as_index(j)), moved, j, column(sizes_of(gas)));
      Eigen::Index row = 0;
      worst = std::max(worst, e.maxCoeff(&row));
      EXPECT_LT(e(row), 1e-6) << names[as_size(row)] << " by " << name(j) << ", point " << i;
    }
  }
  RecordProperty("worst_parts_per_billion", static_cast<int>(1e9 * worst));
}

TEST(GasPathJacobian, BleedValvesThatAreShutHaveTheSlopeOfOpening) {
  const Turbofan engine(jt9d());
  OperatingPoint p = OperatingPoints(engine, 22).next();
  p.operation.geometry.vbv_fraction = 0.0;
  OnBoardEngine board(engine);
  GasPath gas;
  GasPathJacobian jacobian;
  ASSERT_EQ(board.evaluate(p.operation, p.speeds, gas, jacobian, &p.metal), GasPathStatus::ok);
  const Moved moved(engine, p, board.unknowns());
  constexpr double h = 1e-4;
  const Column y0 = moved.by(gas_path_input::vbv, 0.0), y1 = moved.by(gas_path_input::vbv, h),
               y2 = moved.by(gas_path_input::vbv, 2.0 * h);
  const Column opening = (4.0 * y1 - 3.0 * y0 - y2) / (2.0 * h), size = column(sizes_of(gas));
  const Column exact = jacobian.col(gas_path_input::vbv);
  EXPECT_LT(((exact - opening).abs() / opening.abs().max(size)).maxCoeff(), 1e-5);
  EXPECT_GT(std::abs(exact(as_index(*place("w_30_kg_s")))), 0.1);  // it does open
}

TEST(GasPathJacobian, WithoutHeatSoakTheMetalsRowsAndColumnsAreZero) {
  const Turbofan engine(jt9d());
  const OperatingPoint p = OperatingPoints(engine, 23).next();
  OnBoardEngine board(engine);
  GasPath gas;
  GasPathJacobian jacobian;
  ASSERT_EQ(board.evaluate(p.operation, p.speeds, gas, jacobian), GasPathStatus::ok);
  EXPECT_TRUE(jacobian.middleRows<metal_count>(2).isZero(0.0));
  EXPECT_TRUE(jacobian.middleCols<metal_count>(gas_path_input::first_metal).isZero(0.0));
  ASSERT_EQ(board.evaluate(p.operation, p.speeds, gas, jacobian, &p.metal), GasPathStatus::ok);
  EXPECT_FALSE(jacobian.middleRows<metal_count>(2).isZero(1e-3));
}

TEST(GasPathJacobian, AnInputThatIsAQuantityHasItselfAsDerivative) {
  const Turbofan engine(jt9d());
  const OperatingPoint p = OperatingPoints(engine, 24).next();
  OnBoardEngine board(engine);
  GasPath gas;
  GasPathJacobian jacobian;
  ASSERT_EQ(board.evaluate(p.operation, p.speeds, gas, jacobian), GasPathStatus::ok);
  for (const std::size_t input : {gas_path_input::n1, gas_path_input::n2, gas_path_input::fuel_flow}) {
    const auto row = as_index(*place(name(input)));
    for (Eigen::Index j = 0; j < jacobian.cols(); ++j) {
      EXPECT_EQ(jacobian(row, j), j == as_index(input) ? 1.0 : 0.0);
    }
  }
}

TEST(UnknownsTangent, GuessesWithAnErrorOfSecondOrder) {
  const Turbofan engine(jt9d());
  const ThrottleSlam slam(engine, high_cruise, 1.0);
  const SteadyPoint& idle = slam.idle();
  const Intake in = intake(engine.data().inlet, high_cruise);
  GasPathJacobian jacobian;
  FlowUnknowns solved = idle.unknowns;
  engine.gas_path(idle.operation, idle.gas.speeds, solved);
  const auto slopes = differentiate(engine, in, idle.operation, idle.gas.speeds, solved, nullptr, jacobian);
  ASSERT_TRUE(slopes);
  UnknownsTangent tangent;
  tangent.turn(*slopes);
  EXPECT_FALSE(tangent.continued(inputs_of(idle.operation, idle.gas.speeds, nullptr), in));  // from nowhere yet
  tangent.solved(inputs_of(idle.operation, idle.gas.speeds, nullptr), in, solved);
  const auto miss = [&](double step) {
    Operation moved = idle.operation;
    moved.fuel_flow_kg_s *= 1.0 + step;
    moved.health[hpc_efficiency] = -0.1 * step;
    const auto guess = tangent.continued(inputs_of(moved, idle.gas.speeds, nullptr), in);
    FlowUnknowns exact = solved;
    engine.gas_path(moved, idle.gas.speeds, exact);
    return std::abs(guess->r_line_hpc - exact.r_line_hpc);
  };
  EXPECT_NEAR(miss(0.02) / miss(0.01), 4.0, 0.4);
  Operation far = idle.operation;
  far.fuel_flow_kg_s *= 20.0;
  EXPECT_FALSE(tangent.continued(inputs_of(far, idle.gas.speeds, nullptr), in));
}

TEST(GasPathQuantities, HaveTheirNamesOnce) {
  EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()).size(), names.size());
  GasPath gas;
  gas.s24.pt_pa = 1.0;
  gas.s48.tt_k = 2.0;
  gas.s50.w_kg_s = 3.0;
  gas.ps_30_pa = 4.0;
  gas.n2_dot_rpm_s = 5.0;
  gas.stall_margin_hpc_percent = 6.0;
  gas.net_thrust_n = 7.0;
  gas.metal_dot_k_s[lpt_metal] = 8.0;
  const auto y = quantities_of(gas);
  double expected = 0.0;
  for (const char* quantity : {"pt_24_pa", "tt_48_k", "w_50_kg_s", "ps_30_pa", "n2_dot_rpm_s", "stall_margin_hpc",
                               "net_thrust_n", "metal_lpt_dot_k_s"}) {
    ASSERT_TRUE(place(quantity)) << quantity;
    EXPECT_EQ(y[*place(quantity)], expected += 1.0) << quantity;
  }
  EXPECT_FALSE(place("tt_49_k"));
}

}  // namespace
}  // namespace ehm::engine_sim
