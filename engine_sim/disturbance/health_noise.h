// SPDX-License-Identifier: Apache-2.0
#pragma once
// Process noise of the health parameters. In sample k parameter j is off what wear and orders make of it by
//
//   white         v_j[k] = sigma_j e_j[k]
//   accumulated   v_j[k] = v_j[k-1] + sigma_j e_j[k],  v_j[-1] = 0: after n samples sigma_j sqrt(n), unbounded
//
// e: deviates of deploy/runtime/numbers/noise_distribution.h; v and sigma in the parameter's unit. v[k] acts from
// sample k to the next, and on the readings of k.
// One stream by seed, of which no sensor draws; each sample draws for every parameter, so that the noise of one does
// not depend on the sigma of another. Source of the white one: Lu et al., Energies 2013. Errors: none.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "deploy/runtime/numbers/noise_source.h"
#include "engine_sim/disturbance/process_noise.h"

namespace ehm::engine_sim {

class HealthNoise {
 public:
  HealthNoise(const ProcessNoise& noise, std::size_t parameters, std::uint64_t seed);

  /// On to the next sample; before the first call every parameter is off by 0.
  void next();
  /// In the present sample.
  double of_sample(std::size_t parameter) const { return value_.at(parameter); }
  /// What of that is still there in the next sample: nothing of white noise.
  double lasting(std::size_t parameter) const { return accumulate_ ? value_.at(parameter) : 0.0; }

 private:
  NoiseDistribution distribution_;
  bool accumulate_;
  std::vector<double> sigma_, value_;
  NoiseSource random_;
};

}  // namespace ehm::engine_sim
