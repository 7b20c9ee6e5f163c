// SPDX-License-Identifier: Apache-2.0
#pragma once
// The configuration keys that belong to the engine: engine.model, [sensors] and [control]. What is not given is what
// the engine file says, so that a flight of another engine has that engine's limits and noise; the defaults that are
// printed are those of the default engine.

#include <array>
#include <string>
#include <vector>

#include "deploy/runtime/config/schema.h"
#include "engine_sim/scenario/scenario.h"

namespace ehm::engine_sim {

class EngineKeys {
 public:
  /// Declares the keys; this and `scenario` must outlive the schema's use.
  void declare(config::Schema& schema, Scenario& scenario);

  /// Puts the engine that engine.model names into the scenario; at the first call only, since tables ask before the
  /// end. @throws config::ConfigError if there is none of that name, or its file has a defect
  void take_engine(Scenario& scenario);
  /// After the load: control and sensors are the engine's but for the keys that were given.
  void finish(const std::vector<std::string>& given, Scenario& scenario) const;

 private:
  std::string model_ = "jt9d", noise_of_ = std::string(noise_of_names[0]);
  bool taken_ = false;
  std::array<double, 7> sensor_values_{};
};

}  // namespace ehm::engine_sim
