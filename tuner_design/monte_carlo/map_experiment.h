// SPDX-License-Identifier: Apache-2.0
#pragma once
// MAP estimators hhat = E y on one noisy snapshot of each of many engines ([SG] eqs. 19-37), beside their theory.
//
//   theory           (E H - I) Ph (E H - I)^T + E R E^T, with Hz in front for z
//   linearisation    E Lambda_y E^T for h, [Hz E, -I] Lambda [Hz E, -I]^T for z
// A snapshot is y less the steady answer to the controls, (C (I-A)^-1 B + D) u; z likewise. Both estimators see the
// same snapshots. Engine i draws from the stream (seed, i), as in kalman_experiment.h.

#include "tuner_design/monte_carlo/evaluation.h"
#include "tuner_design/monte_carlo/truth.h"

namespace ehm::tuner_design {

struct MapOptions {
  std::size_t engines = 100000;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// Full order, and on the tuners V (t x p, any of full row rank). The design gives model, scaling and fleet.
/// @throws std::invalid_argument if V is rank deficient; std::runtime_error as average_over_engines.
std::vector<Experiment> map_experiment(const design::Design& design, const Eigen::MatrixXd& V, const Truth& truth,
                                       const MapOptions& options, const std::function<void(std::size_t)>& done);

}  // namespace ehm::tuner_design
