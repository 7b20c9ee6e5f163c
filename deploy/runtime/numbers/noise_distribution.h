// SPDX-License-Identifier: Apache-2.0
#pragma once
// Deviates e of a noise whose standard deviation is 1, each independent of all others, by its distribution:
//
//   none               0
//   gaussian           n                          mean 0                          skewness 0
//   rayleigh           a r                        mean sqrt(pi/(4 - pi)) = 1.913  skewness 0.6311
//   rayleigh_shifted   a r - sqrt(pi/(4 - pi))    mean 0                          skewness 0.6311
//
// n and n' are standard normal; r = sqrt(n^2 + n'^2) is Rayleigh of parameter 1, its variance 2 - pi/2; so
// a = 1/sqrt(2 - pi/2) = 1.526 is the parameter of a noise of sigma 1. Skewness: 2 sqrt(pi) (pi - 3) / (4 - pi)^1.5.
// A distribution draws as many normal deviates at each call: a stream never depends on what it gave.
// Source: Papoulis, Probability, Random Variables, and Stochastic Processes, chapter 6 (Rayleigh as the length of two
// normal deviates). Errors: none.

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace ehm {

enum class NoiseDistribution { none, gaussian, rayleigh, rayleigh_shifted };
inline constexpr std::array<std::string_view, 4> noise_distribution_names{"none", "gaussian", "rayleigh",
                                                                          "rayleigh_shifted"};

/// Of `rayleigh`, for a standard deviation of 1.
inline const double rayleigh_mean = std::sqrt(std::numbers::pi / (4.0 - std::numbers::pi));

/// `random`: what has normal(), such as NoiseSource.
template <class Random>
double deviate(NoiseDistribution distribution, Random& random) {
  if (distribution == NoiseDistribution::none) return 0.0;
  const double n = random.normal();
  if (distribution == NoiseDistribution::gaussian) return n;
  const double rayleigh = std::hypot(n, random.normal()) / std::sqrt(2.0 - std::numbers::pi / 2.0);
  return distribution == NoiseDistribution::rayleigh ? rayleigh : rayleigh - rayleigh_mean;
}

}  // namespace ehm
