// SPDX-License-Identifier: Apache-2.0
// The three methods of Endurthi's thesis on plants whose derivatives are known, and on the engine.

#include "tuner_design/linearise/block_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/numbers/noise_source.h"
#include "engine_sim/engines/jt9d.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/model/onboard/gas_path_jacobian.h"
#include "engine_sim/model/parts/inlet.h"
#include "tuner_design/linearise/linearise.h"
#include "tuner_design/linearise/open_loop.h"

namespace ehm::tuner_design {
namespace {

constexpr ColumnMethod all_methods[] = {ColumnMethod::perturbation, ColumnMethod::linmod, ColumnMethod::steady_state};
constexpr Eigen::Index n = 2, nu = 1, p = 2, outputs = 5;  // two rates, three sensors

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  NoiseSource random(seed);
  Eigen::MatrixXd matrix(rows, columns);
  for (double& entry : matrix.reshaped()) entry = random.normal();
  return matrix;
}

/// [A B L; C D M] with a stable A.
Eigen::MatrixXd jacobian_of(std::uint64_t seed) {
  Eigen::MatrixXd jacobian = random_matrix(outputs, n + nu + p, seed);
  jacobian.topLeftCorner(n, n) << -2.0, 0.5, 0.3, -1.0;
  return jacobian;
}

/// f = J (v - v0) + curvature (v - v0)_i^2 on each output, v0 = 1.
Plant plant_with(const Eigen::MatrixXd& jacobian, double curvature) {
  Plant plant{.states = n,
              .controls = nu,
              .health = p,
              .v0 = Eigen::VectorXd::Ones(n + nu + p),
              .f0 = Eigen::VectorXd::Zero(outputs),
              .size = Eigen::VectorXd::Ones(n + nu + p),
              .lowest = Eigen::VectorXd::Constant(n + nu + p, -std::numeric_limits<double>::infinity()),
              .f = {}};
  plant.f = [jacobian, curvature, v0 = plant.v0](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    const Eigen::VectorXd d = v - v0;
    return jacobian * d + curvature * d.squaredNorm() * Eigen::VectorXd::Ones(outputs);
  };
  return plant;
}

Eigen::MatrixXd by_all(const Plant& plant, ColumnMethod method, const ColumnSteps& steps) {
  const Eigen::MatrixXd states = state_columns(plant, method, steps);
  Eigen::MatrixXd jacobian(plant.outputs(), plant.inputs());
  jacobian << states, control_columns(plant, method, steps, states), health_columns(plant, method, steps, states);
  return jacobian;
}

TEST(BlockColumns, ALinearPlantIsFoundByEveryMethod) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Eigen::MatrixXd jacobian = jacobian_of(seed);
    const Plant plant = plant_with(jacobian, 0.0);
    for (const ColumnMethod method : all_methods)
      EXPECT_LT((by_all(plant, method, {}) - jacobian).norm(), 1e-9 * jacobian.norm()) << seed;
  }
}

// A one-sided difference misses by the step times the curvature, a central one by nothing, linmod by 1e-5 (1 + 1e-3).
TEST(BlockColumns, TheErrorOnASmoothPlantIsThatOfTheStep) {
  const double curvature = 0.7, step = -1e-3;
  const Eigen::MatrixXd jacobian = jacobian_of(3);
  const Plant plant = plant_with(jacobian, curvature);
  const auto missed = [&](ColumnMethod method, const ColumnSteps& steps) -> Eigen::MatrixXd {
    return by_all(plant, method, steps) - jacobian;
  };
  const Eigen::MatrixXd one_sided = missed(ColumnMethod::perturbation, {.relative = step});
  EXPECT_NEAR(one_sided.maxCoeff(), curvature * step, 1e-9);
  EXPECT_NEAR(one_sided.minCoeff(), curvature * step, 1e-9);
  EXPECT_LT(missed(ColumnMethod::perturbation, {.relative = step, .central = true}).norm(), 1e-9);
  EXPECT_NEAR(missed(ColumnMethod::linmod, {}).maxCoeff(), curvature * 1.001e-5, 1e-9);
}

TEST(BlockColumns, WithWhateverStatesTheSteadyResponseIsTheSecant) {
  const ColumnSteps steps{.relative = -0.02};
  const Plant plant = plant_with(jacobian_of(4), 0.7);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Eigen::MatrixXd states = jacobian_of(100 + seed).leftCols(n);  // not the plant's
    const Eigen::MatrixXd columns = health_columns(plant, ColumnMethod::steady_state, steps, states);
    const Eigen::MatrixXd H =
        columns.bottomRows(outputs - n) -
        states.bottomRows(outputs - n) * states.topRows(n).partialPivLu().solve(columns.topRows(n));
    for (Eigen::Index j = 0; j < p; ++j) {
      const Eigen::VectorXd rest = settled(plant, plant.moved(plant.first_health() + j, steps.relative));
      const Eigen::VectorXd secant = plant.f(rest).tail(outputs - n) / steps.relative;
      EXPECT_LT((H.col(j) - secant).norm(), 1e-8 * secant.norm()) << seed;
    }
  }
}

// y = |h - corner|, the corner 3e-5 below trim: linmod looks up and sees one slope, 1e-4 down lies beyond.
TEST(BlockColumns, OnlyALongStepKnowsOfACorner) {
  Plant plant = plant_with(Eigen::MatrixXd::Zero(outputs, n + nu + p), 0.0);
  const double corner = 3e-5;
  plant.f = [v0 = plant.v0, corner](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(outputs);
    f.head(n) = v0.head(n) - v.head(n);
    f(n) = std::abs(v(n + nu) - v0(n + nu) + corner);
    return f;
  };
  plant.f0 = plant.f(plant.v0);
  const ColumnSteps steps{.relative = -1e-4};
  const auto slope = [&](ColumnMethod method, const ColumnSteps& with) {
    return by_all(plant, method, with)(n, n + nu);
  };
  EXPECT_NEAR(slope(ColumnMethod::linmod, steps), 1.0, 1e-9);
  // from 3e-5 over 0 to 7e-5: rises by 4e-5 over -1e-4
  EXPECT_NEAR(slope(ColumnMethod::perturbation, steps), -0.4, 1e-9);
  EXPECT_NEAR(slope(ColumnMethod::steady_state, steps), -0.4, 1e-9);
  EXPECT_NEAR(slope(ColumnMethod::perturbation, {.relative = -1e-4, .central = true}), 0.3, 1e-9);
}

TEST(BlockColumns, AnInputThatCannotBeLessIsMovedUp) {
  const double curvature = 0.7;
  const Eigen::MatrixXd jacobian = jacobian_of(5);
  Plant plant = plant_with(jacobian, curvature);
  plant.lowest(n) = plant.v0(n);
  for (const bool central : {false, true}) {
    const Eigen::MatrixXd columns = control_columns(plant, ColumnMethod::perturbation,
                                                    {.relative = -1e-3, .central = central}, jacobian.leftCols(n));
    EXPECT_NEAR((columns - jacobian.col(n)).maxCoeff(), curvature * 1e-3, 1e-9);
  }
}

TEST(OpenLoop, TheStatesDecayAsTheExponential) {
  Plant plant = plant_with(Eigen::MatrixXd::Zero(outputs, n + nu + p), 0.0);
  plant.f = [](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(outputs);
    f(0) = 1.0 - v(0);
    return f;
  };
  EXPECT_NEAR(after(plant, plant.moved(0, 0.1), 0.02)(0) - 1.0, 0.1 * std::exp(-0.02), 1e-12);
}

TEST(OpenLoop, WhatNeverRestsIsAnError) {
  Plant plant = plant_with(jacobian_of(6), 0.0);
  plant.f = [](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(outputs, 1.0 + v.squaredNorm());
  };
  EXPECT_THROW(settled(plant, plant.v0), std::runtime_error);
}

class BlockColumnsOfTheEngine : public ::testing::Test {
 protected:
  static linear_model::LinearModel made(const BlockMethods& blocks) {
    LineariseOptions options;
    options.flight = {10668.0, 0.8, 0.0};
    options.demand = {engine_sim::DemandKind::t40_k, 1308.6};
    options.fleet = 0;
    options.blocks = blocks;
    return linearise(engine_sim::default_engine(), options).model;
  }
  /// Largest relative difference of a column of [A B L; C D M], rows in their trims.
  static double difference(const linear_model::LinearModel& a, const linear_model::LinearModel& b) {
    Eigen::VectorXd size(9);
    size << linear_model::trims(b.states), linear_model::trims(b.sensors);
    const auto whole = [&](const linear_model::LinearModel& m) -> Eigen::MatrixXd {
      Eigen::MatrixXd all(9, 17);
      all << m.A, m.B, m.L, m.C, m.D, m.M;
      return size.cwiseInverse().asDiagonal() * all;
    };
    return ((whole(a) - whole(b)).colwise().norm().array() / whole(b).colwise().norm().array()).maxCoeff();
  }
};

// The derivatives by the implicit function theorem from dual numbers are exact to rounding.
TEST_F(BlockColumnsOfTheEngine, TheTangentIsThatOfDualNumbers) {
  const linear_model::LinearModel model = made({});
  const engine_sim::Turbofan turbofan(engine_sim::jt9d());
  const engine_sim::SteadyPoint trim = engine_sim::solve_steady(
      turbofan, engine_sim::FlightCondition{10668.0, 0.8, 0.0}, {}, {engine_sim::DemandKind::t40_k, 1308.6});
  engine_sim::GasPathJacobian exact;
  ASSERT_TRUE(engine_sim::differentiate(turbofan, engine_sim::intake(engine_sim::jt9d().inlet, trim.operation.flight),
                                        trim.operation, trim.gas.speeds, trim.unknowns, nullptr, exact));
  const Eigen::MatrixXd A = exact.topLeftCorner(2, 2), L = exact.topRightCorner(2, 10);
  EXPECT_LT((model.A - A).norm(), 1e-6 * A.norm());
  EXPECT_LT((model.L - L).norm(), 1e-6 * L.norm());
}

TEST_F(BlockColumnsOfTheEngine, OnSmoothMapsTheMethodsAgreeWithTheTangent) {
  const auto same = [](ColumnMethod method, double step, bool central) {
    return BlockMethods{method, method, method, {.relative = step, .central = central}};
  };
  const linear_model::LinearModel tangent = made({});
  EXPECT_LT(difference(made(same(ColumnMethod::linmod, 1e-4, false)), tangent), 1e-3);
  EXPECT_LT(difference(made(same(ColumnMethod::perturbation, -1e-4, true)), tangent), 1e-4);
  EXPECT_LT(difference(made(same(ColumnMethod::perturbation, -1e-4, false)), tangent), 1e-2);
  EXPECT_LT(difference(made(same(ColumnMethod::steady_state, -1e-4, false)), tangent), 1e-2);
  // with a long step only the central difference stays near
  const double one_sided = difference(made(same(ColumnMethod::perturbation, -5e-3, false)), tangent);
  EXPECT_GT(one_sided, 3.0 * difference(made(same(ColumnMethod::perturbation, -5e-3, true)), tangent));
}

TEST_F(BlockColumnsOfTheEngine, EachBlockHasItsMethodAndTheOthersStay) {
  const linear_model::LinearModel tangent = made({});
  const linear_model::LinearModel mixed =
      made({std::nullopt, std::nullopt, ColumnMethod::perturbation, {.relative = -5e-3}});
  EXPECT_EQ(mixed.A, tangent.A);
  EXPECT_EQ(mixed.D, tangent.D);
  EXPECT_GT((mixed.L - tangent.L).norm(), 1e-4 * tangent.L.norm());
  LineariseOptions options;
  options.flight = {10668.0, 0.8, 0.0};
  options.demand = {engine_sim::DemandKind::t40_k, 1308.6};
  options.method = LineariseMethod::fleet;
  options.fleet = 20;
  options.blocks.health = ColumnMethod::linmod;
  EXPECT_THROW(linearise(engine_sim::default_engine(), options), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::tuner_design
