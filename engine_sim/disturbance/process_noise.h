// SPDX-License-Identifier: Apache-2.0
#pragma once
// What moves an engine besides its own equations, as plain data: noise of its health (health_noise.h) and of its speeds
// (speed_noise.h), drawn anew for each sample. Both are given per sample, as a linear model's process_noise is: with
// another sample time the same motion has another sigma. Errors: none.

#include <algorithm>
#include <vector>

#include "deploy/runtime/numbers/noise_distribution.h"

namespace ehm::engine_sim {

struct ProcessNoise {
  NoiseDistribution distribution = NoiseDistribution::none;  ///< none: off, whatever the sigmas are
  std::vector<double> health_sigma{};  ///< of one sample, by health parameter, in its unit; those that are missing: 0
  bool accumulate = false;             ///< of health: a random walk instead of white noise
  double speed_sigma_percent = 0.0;    ///< of one sample, of the present speed

  /// Whether anything is moved.
  bool on() const {
    const auto moves = [](double sigma) { return sigma > 0.0; };
    return distribution != NoiseDistribution::none &&
           (moves(speed_sigma_percent) || std::any_of(health_sigma.begin(), health_sigma.end(), moves));
  }
};

}  // namespace ehm::engine_sim
