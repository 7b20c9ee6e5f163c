// SPDX-License-Identifier: Apache-2.0
#pragma once
// Quantiles behind the thresholds of the detectors. Not on the cycle path: called at construction.
//
//   normal_quantile_above(p)     z with P(N > z) = p, by bisection of the complementary error function
//   chi_square_quantile(k, z)    the value that a chi-square with k degrees of freedom exceeds as often as N exceeds z;
//                                Wilson and Hilferty's cube root: k (1 - 2/(9k) + z sqrt(2/(9k)))^3. k: any number.
// Errors: none; p in (0, 1), k above 0.

#include <cmath>

namespace ehm::monitor {

inline double normal_quantile_above(double tail) {
  double low = -40.0, high = 40.0;
  for (int i = 0; i < 80; ++i) {
    const double z = 0.5 * (low + high);
    (0.5 * std::erfc(z / std::sqrt(2.0)) > tail ? low : high) = z;
  }
  return low;
}

inline double chi_square_quantile(double k, double z) {
  const double c = 2.0 / (9.0 * k);
  return k * std::pow(1.0 - c + z * std::sqrt(c), 3);
}

}  // namespace ehm::monitor
