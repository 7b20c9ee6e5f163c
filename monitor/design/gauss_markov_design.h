// SPDX-License-Identifier: Apache-2.0
#pragma once
// Gain of the full-order Gauss-Markov filter (estimation/gauss_markov_filter.h) for one set of sensors:
//
//   A = [A L; 0 rho I],  C = [C M],  Q = blkdiag(Q, (1 - rho^2) Ph);   P from the Riccati equation over the used
//   sensors, K = P C^T (C P C^T + R)^-1
//
// It is a filter on the p "tuners" q = h, V = W = I, whose integrators leak. Rows and columns: [x; h], n + p; scaled
// units. Its response: what the sensors do not see, null(H_rho) with H_rho = C (rho I - A)^-1 L + M, forgets with rho,
// which the sensors neither cause nor cure; the slowest time constant is that of all the rest, of Acl on the complement
// of [ (rho I - A)^-1 L; I ] null(H_rho).

#include <vector>

#include "monitor/design/design.h"

namespace ehm::design {

/// rho of a health parameter that forgets with the time constant memory_s.
double rho_of(double memory_s, double sample_time_s) noexcept;

/// `model` is discrete and scaled, `sensors` ascending; 0 < rho < 1. Fills sensors, V, W, A, B, C, K, P and the slowest
/// time constant.
/// @throws std::invalid_argument if rho is out of range; estimation::SolverError if a solver fails.
SubsetDesign gauss_markov_filter(const linear_model::LinearModel& model, const std::vector<int>& sensors, double rho);

}  // namespace ehm::design
