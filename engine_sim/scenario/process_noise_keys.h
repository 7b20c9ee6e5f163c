// SPDX-License-Identifier: Apache-2.0
#pragma once
// The configuration keys [process_noise], and what [[health_noise]] tables say of single health parameters instead.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "deploy/runtime/config/schema.h"
#include "engine_sim/disturbance/process_noise.h"

namespace ehm::engine_sim {

class ProcessNoiseKeys {
 public:
  /// The most that a sample's sigma may be, as a fraction of nominal.
  static constexpr double most_health_sigma = 0.01;

  /// Declares the keys; this must outlive the schema's use.
  void declare(config::Schema& schema);
  /// Of one parameter, in its unit, whatever process_noise.health_sigma is.
  void state(std::size_t parameter, double sigma) { stated_.emplace_back(parameter, sigma); }
  /// After the load. `unit`: by health parameter, one in its unit, and 0 of a parameter that the truth does not show,
  /// whose noise is what is stated of it.
  /// @throws config::ConfigError if the keys do not go together.
  ProcessNoise value(const std::vector<std::string>& given, const std::vector<double>& unit) const;

 private:
  void check(const std::vector<std::string>& given) const;
  /// Without a distribution nothing else may be given.
  void check_absent(const std::vector<std::string>& given) const;

  std::string distribution_{noise_distribution_names[0]};
  double health_sigma_ = 0.0, speed_sigma_percent_ = 0.0;
  bool accumulate_ = false;
  std::vector<std::pair<std::size_t, double>> stated_;
};

}  // namespace ehm::engine_sim
