// SPDX-License-Identifier: Apache-2.0
#pragma once
// The table of baselines (baselines.h) as text, JSON and CSV: the same numbers, squared errors in percent^2 and in the
// squared reporting units of the auxiliary outputs.

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "tuner_design/baselines/baselines.h"

namespace ehm::tuner_design {

/// Array of {name, description, ssee_health, ssee_auxiliary, over_limit_health, over_limit_auxiliary,
/// slowest_time_constant_s}; the ratios are null where the limit is 0, the time constant where there is none.
nlohmann::ordered_json baselines_as_json(const design::Design& design, const std::vector<Baseline>& table);

void print_baselines(const std::vector<Baseline>& table, std::ostream& out);

/// baseline,description,slowest_time_constant_s,ssee_health,ssee_auxiliary, then one column a channel; empty where
/// there is no time constant.
std::string baselines_as_csv(const design::Design& design, const std::vector<Baseline>& table);

}  // namespace ehm::tuner_design
