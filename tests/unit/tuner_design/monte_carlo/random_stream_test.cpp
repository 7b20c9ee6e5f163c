// SPDX-License-Identifier: Apache-2.0
// The random numbers of Monte Carlo: the generator against its published definition, the normal deviates against the
// distribution.

#include "tuner_design/monte_carlo/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace ehm::tuner_design {
namespace {

double normal_distribution(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

std::vector<double> deviates(std::size_t count) {
  RandomStream random(2026, 0);
  std::vector<double> result(count);
  for (double& each : result) each = random.normal();
  return result;
}

TEST(RandomStream, IsTheGeneratorOfItsAuthors) {
  // First numbers of xoshiro256++ 1.0 from the state {1, 2, 3, 4}; the first by hand: rotl(1 + 4, 23) + 1. The others
  // are also what the crate rand_xoshiro checks, made by the authors' C code.
  RandomStream random({1, 2, 3, 4});
  for (const std::uint64_t expected : {41943041ULL, 58720359ULL, 3588806011781223ULL, 3591011842654386ULL,
                                       9228616714210784205ULL, 9973669472204895162ULL})
    EXPECT_EQ(random.bits(), expected);
}

TEST(RandomStream, SameSeedAndIndexSameNumbersOtherwiseOthers) {
  RandomStream a(1, 5), b(1, 5), other_index(1, 6), other_seed(2, 5), swapped(5, 1);
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t bits = a.bits();
    EXPECT_EQ(bits, b.bits());
    EXPECT_NE(bits, other_index.bits());
    EXPECT_NE(bits, other_seed.bits());
    EXPECT_NE(bits, swapped.bits());
  }
}

TEST(RandomStream, UniformFillsTheOpenInterval) {
  RandomStream random(3, 0);
  double sum = 0.0, least = 1.0, most = 0.0;
  constexpr int n = 1000000;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    sum += u;
    least = std::min(least, u), most = std::max(most, u);
  }
  EXPECT_NEAR(sum / n, 0.5, 4.0 / std::sqrt(12.0 * n));
  EXPECT_GT(least, 0.0);
  EXPECT_LT(least, 1e-5);
  EXPECT_LT(most, 1.0);
  EXPECT_GT(most, 1.0 - 1e-5);
}

TEST(Ziggurat, LayersHaveOneAreaAndCloseAtThePeak) {
  const Ziggurat& z = Ziggurat::table();
  const double area = z.edge[0] * z.density[1];
  for (std::size_t i = 1; i < Ziggurat::layers; ++i) {
    EXPECT_GT(z.edge[i], z.edge[i + 1]);
    EXPECT_NEAR(z.edge[i] * (z.density[i + 1] - z.density[i]), area, 1e-14) << "layer " << i;
  }
  // Marsaglia & Tsang give this area for 256 layers, to some ten digits.
  EXPECT_NEAR(area, 0.00492867323399, 1e-13);
}

TEST(NormalDeviate, HasTheMomentsOfTheNormalDistribution) {
  // Of n deviates the k-th moment has the variance (E x^2k - (E x^k)^2)/n, with E x^2k = (2k-1)!!.
  constexpr std::size_t n = 4000000;
  double first = 0.0, second = 0.0, third = 0.0, fourth = 0.0;
  for (const double x : deviates(n)) first += x, second += x * x, third += x * x * x, fourth += x * x * x * x;
  const double root = std::sqrt(static_cast<double>(n));
  EXPECT_NEAR(first / n, 0.0, 4.0 / root);
  EXPECT_NEAR(second / n, 1.0, 4.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(third / n, 0.0, 4.0 * std::sqrt(15.0) / root);
  EXPECT_NEAR(fourth / n, 3.0, 4.0 * std::sqrt(96.0) / root);
}

TEST(NormalDeviate, PassesKolmogorovAndSmirnov) {
  constexpr std::size_t n = 1000000;
  std::vector<double> sorted = deviates(n);
  std::sort(sorted.begin(), sorted.end());
  double distance = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double expected = normal_distribution(sorted[i]);
    distance =
        std::max({distance, (static_cast<double>(i) + 1.0) / n - expected, expected - static_cast<double>(i) / n});
  }
  EXPECT_LT(distance * std::sqrt(static_cast<double>(n)), 1.95) << "the limit of 0.1 % significance";
}

TEST(NormalDeviate, HasItsTailsOnBothSides) {
  // Beyond the start of the ziggurat's tail the transform is another one; each count is binomial.
  constexpr std::size_t n = 8000000;
  const std::vector<double> all = deviates(n);
  for (const double limit : {3.0, Ziggurat::tail_start, 4.5}) {
    for (const double side : {-1.0, 1.0}) {
      const double share = normal_distribution(-limit);
      const auto beyond = std::count_if(all.begin(), all.end(), [&](double x) { return side * x > limit; });
      EXPECT_NEAR(static_cast<double>(beyond), share * n, 4.0 * std::sqrt(share * n)) << side * limit;
    }
  }
}

TEST(NormalDeviate, DoesNotRememberTheLastOne) {
  const std::vector<double> all = deviates(1000000);
  double product = 0.0;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) product += all[i] * all[i + 1];
  EXPECT_NEAR(product / static_cast<double>(all.size()), 0.0, 4.0 / std::sqrt(static_cast<double>(all.size())));
}

}  // namespace
}  // namespace ehm::tuner_design
