// SPDX-License-Identifier: Apache-2.0
#pragma once
// Mean and covariance of a Gaussian inside a box, one constraint after the other.
//
// One coordinate: for u ~ N(0, 1) given low <= u <= high
//   mu = E[u],   s^2 = E[(u - mu)^2]
// and for x ~ N(xhat, P) with l <= x_i <= h, low = (l - xhat_i)/sqrt(P_ii), high likewise,
//   xhat <- xhat + P_:i mu/sqrt(P_ii),   P <- P - (1 - s^2) P_:i P_i: / P_ii
// Simon & Simon reach the same by an eigendecomposition and a Gram-Schmidt rotation that makes the constrained
// direction the first of independent coordinates; written out, the rotation cancels. 0 <= s^2 <= 1 here, so that P
// stays semidefinite. Each constraint takes what the ones before have left for a Gaussian: exact for one, and for
// several where the coordinates are independent; else the order matters a little, and it is that of the coordinates.
//
// The moments are sums of a Gauss-Legendre rule over where the density is above e^-40 of its greatest value in the
// interval, taken from there: no difference of error functions, so that they hold in the far tail (1e-13 at 1e6 sigma).
//
// Source: D. Simon & D.L. Simon, Constrained Kalman filtering via density function truncation for turbofan engine
// health estimation, Int. J. of Systems Science 41 (2010), eqs. 16-32. Errors: values. Real-time safe: yes, all of it.

#include "monitor/estimation/constrained/box_projection.h"

namespace ehm::estimation {

struct TruncatedMoments {
  double mean = 0.0, variance = 1.0;
};

/// Of N(0, 1) between `low` and `high`, low <= high, either may be infinite.
TruncatedMoments truncated_moments(double low, double high) noexcept;

/// x and P become those inside the box. A coordinate that P says is known, P_ii = 0, stays. @returns false, and changes
/// nothing, if a bound lies above its partner or a number is not one.
bool truncate_to_box(const HealthVector& lower, const HealthVector& upper, HealthVector& x,
                     HealthCovariance& P) noexcept;

}  // namespace ehm::estimation
