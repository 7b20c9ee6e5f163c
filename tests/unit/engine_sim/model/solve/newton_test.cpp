// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/solve/newton.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ehm::engine_sim {
namespace {

using Pair = std::array<Dual<2>, 2>;
const NewtonProblem<2> box{{"circle", "line"}, {-10.0, -10.0}, {10.0, 10.0}, {1.0, 1.0}};

TEST(Newton, FindsTheIntersectionOfCircleAndLine) {
  std::array<double, 2> x{5.0, 0.3};
  const NewtonReport report = newton(box, x, [](const Pair& p) {
    return Pair{p[0] * p[0] + p[1] * p[1] - 2.0, p[0] - p[1]};
  });
  EXPECT_NEAR(x[0], 1.0, 1e-10);
  EXPECT_NEAR(x[1], 1.0, 1e-10);
  EXPECT_LT(report.residual, 1e-11);
}

TEST(Newton, NamesTheResidualThatCannotClose) {
  std::array<double, 2> x{1.0, 1.0};
  try {
    newton(box, x, [](const Pair& p) { return Pair{p[0] * p[0] + p[1] * p[1] + 1.0, p[0] - p[1]}; });
    FAIL() << "no real solution exists";
  } catch (const SolveError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("'circle'"));
  }
}

TEST(Newton, StopsAtAResidualThatIsNotFinite) {
  std::array<double, 2> x{-1.0, 0.0};
  EXPECT_THROW(newton(box, x, [](const Pair& p) { return Pair{sqrt(p[0]), p[1]}; }), SolveError);
}

TEST(Newton, TellsAsAValueWhichResidualDoesNotClose) {
  std::array<double, 2> x{1.0, 1.0};
  const auto no_root = [](const Pair& p) { return Pair{p[0] - p[1], p[0] * p[0] + p[1] * p[1] + 1.0}; };
  const NewtonEnd end = try_newton(box, x, no_root);
  EXPECT_FALSE(end.closed);
  EXPECT_EQ(end.worst, 1U);
  EXPECT_GE(end.worst_value, 1.0);  // x^2 + y^2 + 1 is nowhere less
}

TEST(Newton, GivesUpAfterSoManyEvaluations) {
  NewtonProblem<2> in_time = box;
  in_time.max_evaluations = 5;
  int evaluations = 0;
  const auto counted = [&](const Pair& p) {
    ++evaluations;
    return Pair{p[0] * p[0] + p[1] * p[1] + 1.0, p[0] - p[1]};
  };
  std::array<double, 2> x{1.0, 1.0};
  EXPECT_FALSE(try_newton(in_time, x, counted).closed);
  EXPECT_EQ(evaluations, 5);
  in_time.max_evaluations = 50;
  x = {5.0, 0.3};
  EXPECT_TRUE(try_newton(in_time, x, [](const Pair& p) {
                return Pair{p[0] * p[0] + p[1] * p[1] - 2.0, p[0] - p[1]};
              }).closed);
}

}  // namespace
}  // namespace ehm::engine_sim
