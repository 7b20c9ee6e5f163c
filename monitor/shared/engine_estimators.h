// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which estimators fly for which engine: those of [estimator], but for what its [[engine]] table names.
// Errors: std::invalid_argument as design::shadow_names.

#include <string>
#include <vector>

#include "monitor/shared/monitor_config.h"

namespace ehm::monitor {

/// The options of one [[engine]] table's engines.
CycleOptions options_of(const MonitorConfig& config, const EngineAssignment& engines);

/// The shadows of any engine, each once, in the order of the topics and of a recording's rows: those of [estimator]
/// first.
std::vector<std::string> all_shadow_names(const MonitorConfig& config);

/// The places of an engine's shadows in all_shadow_names.
std::vector<int> shadow_places(const EstimatorOptions& options, const std::vector<std::string>& all);

/// As many as can fly beside the tuner filter for one engine, whatever the engines' tables choose among these.
inline std::size_t most_companions(const MonitorConfig& config) {
  return all_shadow_names(config).size() + 1;
}

}  // namespace ehm::monitor
