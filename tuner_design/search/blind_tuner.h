// SPDX-License-Identifier: Apache-2.0
#pragma once
// A trap of the search: a combination of the tuners that no sensor sees. The MAP estimator then simply never moves it,
// and turning it a little towards one that is seen can make J worse before it makes it better: a stationary point far
// above the optimum. With S the sensitivities R^-1/2 H of all points, one above the other, and W = V^T:
//   blind      least singular value of S W below 1e-3 of the t-th of S (the best that t tuners can have)
//   instead    the strongest direction of S that the other t - 1 combinations leave out
// Source: own observation, on the health-only MAP objective of [SG] table 4.

#include <optional>

#include "tuner_design/search/tuner_search.h"

namespace ehm::tuner_design {

/// Orthonormal rows with the blind combination replaced; nullopt if none is blind.
std::optional<Eigen::MatrixXd> without_blind_tuner(const SearchProblem& problem, const Eigen::MatrixXd& V);

}  // namespace ehm::tuner_design
