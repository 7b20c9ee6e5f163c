// SPDX-License-Identifier: Apache-2.0
#pragma once
// Objective J (point_problem.h) of the reduced MAP estimator on the tuners V, and its gradient ([SG] eqs. 28-37). For
// orthonormal rows W = V^T, and with Pq = V Ph W, Hq = H W:
//   hhat = W Kq y,  Kq = Pq Hq^T (Hq Pq Hq^T + R)^-1              the same as (Pq^-1 + Hq^T R^-1 Hq)^-1 Hq^T R^-1
//   J    = <D, Omega D> + <E R E^T, T^T Omega T>,  E = W Kq,  T = [I; Hz],  D = T E Gy - [Gh; Gz]
// The gradient runs the same chain backwards; only what leaves the row space of V counts.

#include <optional>

#include "tuner_design/theory/point_problem.h"

namespace ehm::tuner_design {

/// As kalman_objective. nullopt if Hq Pq Hq^T + R is not positive definite.
std::optional<double> map_objective(const PointProblem& point, const Eigen::MatrixXd& V,
                                    Eigen::MatrixXd* gradient = nullptr);

}  // namespace ehm::tuner_design
