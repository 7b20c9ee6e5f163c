// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/prepared_design.h"

namespace ehm::monitor {

PreparedDesign::PreparedDesign(std::shared_ptr<const design::Design> of, const CycleOptions& options)
    : design(std::move(of)),
      estimator(options.estimator),
      validity(options.validity),
      tuner(design::make_tuner_model(*design)),
      faults(fault_tables(*design)),
      shift(shift_tables(*design)),
      slow_bias(slow_bias_table(*design)),
      fleet(fleet_tables(*design, *tuner.errors)) {
  const auto companion = [&](const std::string& name) {
    if (name == design::tuner_name) return watch_filter;
    companions.push_back(design::make_estimator(name, *design, estimator, validity));
    return static_cast<int>(companions.size()) - 1;
  };
  published = companion(estimator.published);
  for (const std::string& name : design::shadow_names(estimator)) shadows.push_back(companion(name));
}

}  // namespace ehm::monitor
