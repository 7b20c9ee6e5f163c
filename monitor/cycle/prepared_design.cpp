// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/prepared_design.h"

#include <algorithm>

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
  for (const std::string_view name : design::companion_names(estimator)) {
    const std::shared_ptr<const estimation::Estimator> made =
        design::make_estimator(std::string(name), *design, estimator, validity);
    companions.push_back({name, made, made->span()});
  }
  const auto index_of = [&](const std::string& name) {
    const auto found =
        std::find_if(companions.begin(), companions.end(), [&](const auto& c) { return c.name == name; });
    return found == companions.end() ? watch_filter : static_cast<int>(found - companions.begin());
  };
  published = index_of(estimator.published);
  for (const std::string& name : design::shadow_names(estimator)) shadows.push_back(index_of(name));
}

}  // namespace ehm::monitor
