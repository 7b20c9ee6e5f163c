// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/maps/spline.h"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

namespace ehm::engine_sim {
namespace {

const std::vector<double> breaks{0.0, 0.4, 1.0, 1.5, 3.0};

TEST(SplineBasis, IsAPartitionOfUnityWithSlopesThatSumToZero) {
  const SplineBasis basis(breaks);
  EXPECT_EQ(basis.size(), breaks.size() + 2);
  for (double x = -1.0; x < 4.0; x += 0.05) {
    const BasisValues v = basis.at(x);
    EXPECT_NEAR(std::accumulate(v.b.begin(), v.b.end(), 0.0), 1.0, 1e-14);
    EXPECT_NEAR(std::accumulate(v.slope.begin(), v.slope.end(), 0.0), 0.0, 1e-13);
  }
}

/// Coefficients that reproduce x: the Greville abscissae, means of three consecutive inner knots.
std::vector<double> greville() {
  std::vector<double> knots(3, breaks.front());
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), 3, breaks.back());
  std::vector<double> c;
  for (std::size_t i = 0; i + 4 < knots.size(); ++i) c.push_back((knots[i + 1] + knots[i + 2] + knots[i + 3]) / 3.0);
  return c;
}

TEST(SplineSurface, ReproducesAPlaneInsideAndOutside) {
  const SplineBasis basis(breaks);
  const std::vector<double> x = greville();
  std::vector<double> c;
  for (const double xi : x) {
    for (const double yj : x) c.push_back(1.0 + 2.0 * xi - 3.0 * yj);
  }
  for (double u = -0.7; u < 3.9; u += 0.31) {
    for (double v = -0.7; v < 3.9; v += 0.37) {
      const SurfaceValue s = surface(basis.at(u), basis.at(v), c, basis.size());
      EXPECT_NEAR(s.f, 1.0 + 2.0 * u - 3.0 * v, 1e-12);
      EXPECT_NEAR(s.by_x, 2.0, 1e-12);
      EXPECT_NEAR(s.by_y, -3.0, 1e-12);
    }
  }
}

TEST(SplineBasis, RefusesBreakPointsThatDoNotAscend) {
  EXPECT_THROW(SplineBasis(std::vector<double>{1.0}), std::invalid_argument);
  EXPECT_THROW(SplineBasis(std::vector<double>{1.0, 2.0, 2.0}), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::engine_sim
