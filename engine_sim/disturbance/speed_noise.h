// SPDX-License-Identifier: Apache-2.0
#pragma once
// Process noise of the spool speeds: what is added to each of them between a sample and the next.
//
//   N[k+1] = N* + 0.01 p N* e[k]      N*: where the engine's equations lead from sample k, rpm
//
// p: percent of the speed, standard deviation per sample; e: deviates of deploy/runtime/numbers/noise_distribution.h,
// one for each spool. It is the w of a linear model whose process_noise is (0.01 p N)^2 on the speeds, and stands for a
// white acceleration of the intensity (0.01 p N)^2 / dt, rpm^2/s: the engine integrates it, and its control answers.
// One stream by seed, of which neither sensors nor health draw. Errors: none.

#include <cstdint>

#include "deploy/runtime/numbers/noise_source.h"
#include "engine_sim/disturbance/process_noise.h"
#include "engine_sim/model/gas_path.h"

namespace ehm::engine_sim {

class SpeedNoise {
 public:
  SpeedNoise(const ProcessNoise& noise, std::uint64_t seed)
      : distribution_(noise.distribution), fraction_(0.01 * noise.speed_sigma_percent), random_(seed ^ stream) {}

  /// What is added to these speeds; draws for both.
  SpoolSpeeds next(const SpoolSpeeds& speeds) {
    const double e1 = deviate(distribution_, random_), e2 = deviate(distribution_, random_);
    return {fraction_ * speeds.n1_rpm * e1, fraction_ * speeds.n2_rpm * e2};
  }

 private:
  /// A bit that no seed of a scenario has, and not that of health.
  static constexpr std::uint64_t stream = std::uint64_t{1} << 63;

  NoiseDistribution distribution_;
  double fraction_;
  NoiseSource random_;
};

}  // namespace ehm::engine_sim
