// SPDX-License-Identifier: Apache-2.0
#pragma once
// The configuration keys [mission]: a whole flight instead of a profile of one's own. What is not given then is what a
// whole flight needs: heat soak on, noise of the present reading, and the sensors' lags (sensor_lags.h).

#include <string>
#include <vector>

#include "deploy/runtime/config/schema.h"
#include "engine_sim/scenario/mission.h"
#include "engine_sim/scenario/scenario.h"

namespace ehm::engine_sim {

class MissionKeys {
 public:
  /// Declares the keys; this must outlive the schema's use.
  void declare(config::Schema& schema);
  /// After the load; without a mission nothing is changed.
  /// @throws config::ConfigError if a profile or another demand is given besides; files::FileError as
  /// recorded_mission()
  void finish(const std::vector<std::string>& given, Scenario& scenario) const;

 private:
  std::string name_ = "none", file_;
  MissionOptions options_;
};

}  // namespace ehm::engine_sim
