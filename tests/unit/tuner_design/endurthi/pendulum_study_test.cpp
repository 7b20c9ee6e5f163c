// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/pendulum_study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tuner_design/endurthi/pendulum_space.h"

namespace ehm::tuner_design::endurthi {
namespace {

using nonlinear::OrderVector;
using nonlinear::Response;
using nonlinear::Slopes;

TEST(PendulumSpace, SlopesAreThoseOfTheMotionAndOfAStep) {
  PendulumSpace space;
  OrderVector x(4);
  x << 0.3, 2.0, -0.4, 3.0;
  constexpr double h = 1e-6;
  Response response;
  Slopes slopes;
  ASSERT_TRUE(space.respond(x, response, slopes));
  for (Eigen::Index j = 0; j < 4; ++j) {
    OrderVector up = x, down = x;
    up(j) += h;
    down(j) -= h;
    const Eigen::Vector4d rate = (PendulumSpace::rates(up) - PendulumSpace::rates(down)) / (2 * h);
    EXPECT_LT((rate - PendulumSpace::rate_slopes(x).col(j)).norm(), 1e-7) << j;
    Response above, below;
    space.respond(up, above);
    space.respond(down, below);
    EXPECT_LT(((above.next - below.next) / (2 * h) - slopes.f.col(j)).norm(), 1e-8) << j;
  }
}

TEST(PendulumSpace, EnergyOnlyLeavesByFriction) {
  // without friction and input the sum of kinetic and potential energy is conserved; 0.1 N s/m takes F y'^2
  PendulumSpace space;
  OrderVector x(4);
  x << 0.0, 0.1, 0.0, 0.0;
  const auto energy = [](const OrderVector& s) {
    const double inertia = 0.2 * (0.5 * 0.02 * 0.02 + 1.0);
    return 0.5 * 1.2 * s(2) * s(2) + 0.2 * std::cos(s(1)) * s(2) * s(3) + 0.5 * inertia * s(3) * s(3) +
           0.2 * 9.81 * std::cos(s(1));
  };
  double lost = 0.0;
  const double before = energy(x);
  for (int k = 0; k < 600; ++k) {
    Response response;
    space.respond(x, response);
    lost += 0.1 * pendulum_step_s * 0.5 * (x(2) * x(2) + response.next(2) * response.next(2));
    x = response.next;
  }
  EXPECT_NEAR(energy(x) + lost, before, 1e-4);
  EXPECT_GT(std::abs(x(1)), 2.0);  // it has fallen
}

TEST(PendulumStudy, TheJacobianDecidesMoreThanTheFilter) {
  const auto study = run_pendulum_study({.runs = 20, .seed = 3});
  ASSERT_EQ(study.size(), 4u);
  const PendulumFilter &upright = study[0], &extended = study[1], &unscented = study[2];
  EXPECT_GT(upright.angle_after_rad, 3.0 * extended.angle_after_rad);
  EXPECT_LT(unscented.angle_after_rad, 0.2);
  EXPECT_LT(extended.angle_after_rad, 0.2);
}

}  // namespace
}  // namespace ehm::tuner_design::endurthi
