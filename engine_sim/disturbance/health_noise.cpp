// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/disturbance/health_noise.h"

namespace ehm::engine_sim {

namespace {
/// A bit that no seed of a scenario has (they end at 2^53): no flight's sensors draw this stream.
constexpr std::uint64_t stream = std::uint64_t{1} << 62;
}  // namespace

HealthNoise::HealthNoise(const ProcessNoise& noise, std::size_t parameters, std::uint64_t seed)
    : distribution_(noise.distribution),
      accumulate_(noise.accumulate),
      sigma_(noise.health_sigma),
      value_(parameters),
      random_(seed ^ stream) {
  sigma_.resize(parameters);
}

void HealthNoise::next() {
  if (distribution_ == NoiseDistribution::none) return;
  for (std::size_t j = 0; j < value_.size(); ++j)
    value_[j] = (accumulate_ ? value_[j] : 0.0) + sigma_[j] * deviate(distribution_, random_);
}

}  // namespace ehm::engine_sim
