// SPDX-License-Identifier: Apache-2.0
#pragma once
// How well a slow bias of each sensor can be told from deterioration. A bias that grows slowly is seen only as where
// the sensors have come to stand, and that is compared with where the fleet's deterioration may bring them:
//
//   detectability_i = 5 sigma_i sqrt([(H Ph H^T + (R + J Q J^T)/N)^-1]_ii),     J = C (I - A)^-1
//
// the Mahalanobis distance of a bias of five noise sigmas in sensor i, as against the spread of the fleet's steady
// sensors (m x m, scaled; the second term: what averaging over the slowest time constant of the design, N samples,
// leaves of the sensors' noise R and of the engine's own motion, whose spectrum at frequency zero is J Q J^T).
// With as many independent health parameters as sensors every bias is also some deterioration; the distance says how
// far-fetched a one. It is at most 5 sqrt(N), and below 5 a fault of that size is no rarity in the fleet.
// Source: Gelb, Applied Optimal Estimation, ch. 9 (consider covariance); the distance is Mahalanobis' (1936).
// Errors: none for a design that was made.

#include <Eigen/Core>

#include "monitor/design/design.h"

namespace ehm::design {

inline constexpr double detectability_bias_sigmas = 5.0;
/// Above it a slow bias is far enough from deterioration for an event.
inline constexpr double least_detectability = 5.0;

/// By sensor; `full` is the design of all sensors, made of `model`.
Eigen::VectorXd slow_bias_detectability(const linear_model::LinearModel& model, const linear_model::Scaling& scaling,
                                        const SubsetDesign& full);

}  // namespace ehm::design
