// SPDX-License-Identifier: Apache-2.0
#pragma once
// Augmented model and steady-state Kalman gain on given tuners ([SG] eqs. 8, 15-17):
//   Axq = [A, L W; 0, I]   Bxq = [B; 0]   Cxq = [C, M W]   Qxq = blkdiag(Q, V Qh V^T), Qh = qh I
//   P from the Riccati equation over the used sensors,  Kinf = P Cxq^T (Cxq P Cxq^T + R)^-1
// A n x n, V t x p, W = V^+ p x t, Axq (n+t) x (n+t), Cxq m x (n+t); scaled units (percent). Invariant to V -> T V.

#include <Eigen/Core>
#include <vector>

#include "monitor/design/design.h"

namespace ehm::tuner_design {

/// The filter of `sensors` on the tuners V: fills sensors, V, W, A, B, C, K and P of the result, nothing else.
/// `model` is discrete and scaled; qh_percent2 > 0.
/// @throws std::invalid_argument if V is rank deficient; SolverError if the Riccati equation has no solution.
design::SubsetDesign kalman_gain(const linear_model::LinearModel& model, const std::vector<int>& sensors,
                                 const Eigen::MatrixXd& V, double qh_percent2);

}  // namespace ehm::tuner_design
