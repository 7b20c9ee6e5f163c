// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/solve/dual.h"

#include <gtest/gtest.h>

namespace ehm::engine_sim {
namespace {

TEST(Dual, EveryOperationAgreesWithItsDerivativeByHand) {
  const auto x = Dual<2>::variable(3.0, 0), y = Dual<2>::variable(2.0, 1);
  // f = x^2 y / (x + y) - exp(-x) sqrt(y) + log(x) + x^1.5 (1 - 2/y)
  const Dual<2> f = x * x * y / (x + y) - exp(-x) * sqrt(y) + log(x) + pow(x, 1.5) * (1.0 - 2.0 / y);
  const double by_x = 2.0 * (2.0 * 3.0 * 5.0 - 9.0) / 25.0 + std::exp(-3.0) * std::sqrt(2.0) + 1.0 / 3.0;
  const double by_y = 9.0 * (5.0 - 2.0) / 25.0 - std::exp(-3.0) * 0.5 / std::sqrt(2.0) + std::pow(3.0, 1.5) * 2.0 / 4.0;
  EXPECT_NEAR(f.d[0], by_x, 1e-14);
  EXPECT_NEAR(f.d[1], by_y, 1e-14);
}

TEST(Dual, RootOfANegativeValueIsNotFinite) {
  EXPECT_FALSE(std::isfinite(sqrt(Dual<1>::variable(-1.0, 0)).v));
}

}  // namespace
}  // namespace ehm::engine_sim
