// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/process_noise_keys.h"

#include <algorithm>
#include <string_view>

namespace ehm::engine_sim {

namespace {

constexpr double most_speed_sigma_percent = 0.1;

NoiseDistribution distribution_of(std::string_view name) {
  const auto found = std::find(noise_distribution_names.begin(), noise_distribution_names.end(), name);
  return static_cast<NoiseDistribution>(found - noise_distribution_names.begin());
}

}  // namespace

void ProcessNoiseKeys::declare(config::Schema& schema) {
  schema.choice(
      "process_noise.distribution", distribution_, {noise_distribution_names.begin(), noise_distribution_names.end()},
      "of the noise that moves health and speeds in each sample; none: off. Rayleigh deviates are positive, of "
      "mean 1.913 sigma; shifted ones have mean zero");
  schema.real("process_noise.health_sigma", health_sigma_, 0, most_health_sigma, "fraction",
              "standard deviation of one sample's noise on each health parameter, but for those of [[health_noise]]");
  schema.flag("process_noise.accumulate", accumulate_,
              "whether the noise of health adds up from sample to sample, a random walk, instead of being white");
  schema.real(
      "process_noise.speed_sigma_percent", speed_sigma_percent_, 0, most_speed_sigma_percent, "percent",
      "standard deviation of what is added to each spool's speed from a sample to the next, of the present speed");
}

void ProcessNoiseKeys::check(const std::vector<std::string>& given) const {
  const auto is_given = [&](std::string_view key) { return std::find(given.begin(), given.end(), key) != given.end(); };
  const bool of_health = is_given("process_noise.health_sigma") || !stated_.empty();
  if (!is_given("process_noise.distribution")) return check_absent(given);
  if (distribution_ == noise_distribution_names[0]) return;
  const std::string as_set = "'process_noise.distribution' is '" + distribution_ + "', but ";
  if (!of_health && !is_given("process_noise.speed_sigma_percent"))
    throw config::ConfigError(as_set +
                              "no size is given: set 'process_noise.health_sigma', 'process_noise.speed_sigma_percent' "
                              "or [[health_noise]]");
  if (!accumulate_) return;
  if (!of_health)
    throw config::ConfigError(
        "'process_noise.accumulate' is true, but health has no noise: set 'process_noise.health_sigma' or "
        "[[health_noise]]; noise of speeds adds up by the engine's own motion");
  if (distribution_of(distribution_) == NoiseDistribution::rayleigh)
    throw config::ConfigError(
        as_set +
        "with 'process_noise.accumulate' its mean would add up without end: set rayleigh_shifted, "
        "and a drift by 'wear.drift_per_hour'");
}

void ProcessNoiseKeys::check_absent(const std::vector<std::string>& given) const {
  const auto first = std::find_if(given.begin(), given.end(),
                                  [](const std::string& key) { return key.starts_with("process_noise."); });
  if (first == given.end() && stated_.empty()) return;
  throw config::ConfigError("'" + (first == given.end() ? "health_noise" : *first) +
                            "' is given, but not 'process_noise.distribution': set it to gaussian, rayleigh or "
                            "rayleigh_shifted");
}

ProcessNoise ProcessNoiseKeys::value(const std::vector<std::string>& given, const std::vector<double>& unit) const {
  check(given);
  ProcessNoise noise{.distribution = distribution_of(distribution_),
                     .accumulate = accumulate_,
                     .speed_sigma_percent = speed_sigma_percent_};
  for (const double one : unit) noise.health_sigma.push_back(health_sigma_ * one);
  for (const auto& [parameter, sigma] : stated_) noise.health_sigma.at(parameter) = sigma;
  return noise;
}

}  // namespace ehm::engine_sim
