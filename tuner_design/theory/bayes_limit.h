// SPDX-License-Identifier: Apache-2.0
#pragma once
// The limit: no linear estimator that sees only steady data at one operating point has a smaller error of
// h = Gh e and z = Gz e than what the sensors Gy e leave of the unknowns e (design::FleetUnknowns),
//   Gh N N^T Gh^T   and   Gz N N^T Gz^T,       N an orthonormal basis of the null space of Gy, k x (k - rank Gy)
// endless averaging removes the noise, and the prior remains in the directions that the sensors do not see. For a model
// that misses nothing, Gy = H Ph^1/2, this is
//   C0 = Ph - Ph H^T (H Ph H^T)^-1 H Ph,       p x p
// with Lambda it is Ph - Ph H^T (H Ph H^T + Lambda)^-1 H Ph, and the like for z. As squared norms of rows the limits by
// channel are never negative, and exactly zero where the sensors see everything.
// Source: theory.md, section 5 (the limit of [SG] eq. 19 as R -> 0).

#include <Eigen/Core>

#include "monitor/design/design.h"
#include "monitor/design/fleet_unknowns.h"

namespace ehm::tuner_design {

/// U = Ph^1/2 N with C0 = U U^T, p x (p - rank H). @throws std::runtime_error if Ph is not positive definite.
Eigen::MatrixXd bayes_limit_factor(const Eigen::MatrixXd& H, const Eigen::MatrixXd& Ph);

/// Limits by channel for the unknowns as the sensors of `unknowns.sensors` show them.
design::ErrorByChannel steady_limit(const design::FleetUnknowns& unknowns);

}  // namespace ehm::tuner_design
