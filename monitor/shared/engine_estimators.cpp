// SPDX-License-Identifier: Apache-2.0
#include "monitor/shared/engine_estimators.h"

#include <algorithm>

#include "monitor/design/make_estimator.h"

namespace ehm::monitor {

CycleOptions options_of(const MonitorConfig& config, const EngineAssignment& engines) {
  CycleOptions options = config.cycle;
  options.estimator.published = engines.published.value_or(options.estimator.published);
  options.estimator.shadow = engines.shadow.value_or(options.estimator.shadow);
  return options;
}

std::vector<std::string> all_shadow_names(const MonitorConfig& config) {
  std::vector<EstimatorOptions> choices{config.cycle.estimator};
  for (const EngineAssignment& engines : config.engines) choices.push_back(options_of(config, engines).estimator);
  std::vector<std::string> all;
  for (const EstimatorOptions& options : choices)
    for (const std::string& name : design::shadow_names(options))
      if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
  return all;
}

std::vector<int> shadow_places(const EstimatorOptions& options, const std::vector<std::string>& all) {
  std::vector<int> places;
  for (const std::string& name : design::shadow_names(options))
    places.push_back(static_cast<int>(std::find(all.begin(), all.end(), name) - all.begin()));
  return places;
}

}  // namespace ehm::monitor
