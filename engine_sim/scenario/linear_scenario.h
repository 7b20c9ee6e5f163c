// SPDX-License-Identifier: Apache-2.0
#pragma once
// What of a scenario a linear model can fly: wear, changes of health and controls, sensor faults, seed, duration.
// Flight, demand, control, offtakes and sensors are the model's own, and a key that sets them is refused.

#include <string>
#include <vector>

namespace ehm::engine_sim {

/// `given`: the configuration keys that somebody has set.
/// @throws config::ConfigError naming the first one that makes no sense, and why.
void check_linear(const std::vector<std::string>& given);

}  // namespace ehm::engine_sim
