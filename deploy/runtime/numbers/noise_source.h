// SPDX-License-Identifier: Apache-2.0
#pragma once
// Gaussian white noise that is the same on every machine: the generator is specified by the C++ standard, the transform
// to a normal deviate is ours (Box-Muller), since std::normal_distribution differs by library (theory.md, section 10).
//
//   n = sqrt(-2 ln u1) cos(2 pi u2),  u1, u2 uniform in (0, 1]

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace ehm {

class NoiseSource {
 public:
  explicit NoiseSource(std::uint64_t seed) : generator_(seed) {}

  /// Standard normal deviate; two draws of the generator each, so that streams never depend on a cached half.
  double normal() {
    const double u1 = uniform();
    const double u2 = uniform();
    return std::sqrt(-2.0 * std::log(u1)) * std::cos(2.0 * std::numbers::pi * u2);
  }

  /// Uniform in (0, 1]: 53 random bits, shifted off zero.
  double uniform() { return (static_cast<double>(generator_() >> 11) + 1.0) * 0x1.0p-53; }

 private:
  std::mt19937_64 generator_;
};

}  // namespace ehm
