// SPDX-License-Identifier: Apache-2.0
#pragma once
// The point of a box that is nearest to an estimate, in the metric of its covariance:
//
//   min over x of (x - xhat)^T W (x - xhat),   lower <= x <= upper,   W = P^-1 or I
//
// xhat, lower, upper p; P p x p, symmetric, semidefinite; bounds may be infinite. With W = I it is the clamp. With
// W = P^-1 the parameters that stand at a bound, S with b_S, draw the others along as P says they are correlated,
//   x = xhat + P_:S mu_S,   P_SS mu_S = b_S - xhat_S,   mu_j >= 0 at a lower bound, mu_j <= 0 at an upper one
// which is the mean of N(xhat, P) given x_S = b_S: P is used as it is, never inverted, and may be singular. S is found
// by a dual active set method: it starts from xhat with S empty, lets the most violated bound in (in its standard
// deviations), and drops a bound whose multiplier would change its sign on the way. Each step raises the dual
// objective, so that it ends; the bound on steps is for roundoff. Units: any, the same for all but P, which has their
// squares.
//
// Sources: Goldfarb & Idnani, A numerically stable dual method for solving strictly convex quadratic programs, Math.
// Programming 27 (1983); Simon & Simon, Constrained Kalman filtering for turbofan engine health, ASME GT2003-38584.
// Errors: values, see BoxSolution. Real-time safe: yes, all of it.

#include "monitor/estimation/capacity.h"

namespace ehm::estimation {

enum class BoxSolution {
  found,
  infeasible,  ///< no point of the box can be reached along P, a bound lies above its partner, or a number is not one
  unfinished   ///< did not end within the steps that are allowed, or not with numbers
};

/// W = P^-1. `x` is xhat, and becomes the solution; it stays what it is unless one was found.
BoxSolution project_onto_box(const HealthCovariance& P, const HealthVector& lower, const HealthVector& upper,
                             HealthVector& x) noexcept;

/// W = I. `lower` <= `upper`.
inline HealthVector clamped_to_box(const HealthVector& x, const HealthVector& lower,
                                   const HealthVector& upper) noexcept {
  return x.cwiseMax(lower).cwiseMin(upper);
}

}  // namespace ehm::estimation
