// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the steady-state filter of one set of sensors forgets, and where it settles (theory.md, section 4). xq = [x; q]:
//
//   xq+[k] = Acl xq+[k-1] + K y[k] + ...,   Acl = (I - K C) A
//   constant drive d a sample:               xq+ -> (I - Acl)^-1 d
//   process noise w of the n states of x:    enters xq+ by (I - K C) [I; 0] w
//
// Shapes: A, Acl (n+t) x (n+t), K (n+t) x m, C m x (n+t).

#include <Eigen/Core>

#include "monitor/design/design.h"

namespace ehm::design {

/// Acl; stable for a design that the file reader has let in (subset_json.cpp).
Eigen::MatrixXd closed_loop(const SubsetDesign& subset);

/// (I - Acl)^-1 drive, a column for every column of `drive`.
Eigen::MatrixXd settled(const Eigen::MatrixXd& closed_loop, const Eigen::MatrixXd& drive);

/// What each sample's noise of the sensors, and of the engine's own motion, adds to the covariance of xq+:
/// K R K^T + (I - K C) [I; 0] Q [I; 0]^T (I - K C)^T, (n+t) x (n+t). `model` scaled.
Eigen::MatrixXd noise_of_a_sample(const SubsetDesign& subset, const linear_model::LinearModel& model);

/// Covariance of the noise that the sensors and the engine's own motion leave on the tuners, t x t:
/// S = Acl S Acl^T + noise_of_a_sample, its lower right corner. `model` scaled.
/// @throws estimation::SolverError if the closed loop is not stable.
Eigen::MatrixXd tuner_noise(const SubsetDesign& subset, const linear_model::LinearModel& model);

/// (I - K C) [I; 0], (n+t) x n.
Eigen::MatrixXd process_noise_entry(const SubsetDesign& subset, Eigen::Index n);

}  // namespace ehm::design
