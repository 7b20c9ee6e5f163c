// SPDX-License-Identifier: Apache-2.0
#pragma once
// A design in words and numbers: a table for people, one JSON object for scripts. Errors are squared: health in
// percent^2, auxiliary outputs in K^2 (temperatures), points^2 (margins) or percent^2 of trim (the rest).

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "monitor/design/design.h"

namespace ehm::tuner_design {

/// Keys: name, hash, sensors, tuners, qh_percent2, sample_time_s, slowest_time_constant_s, ssee_health, ssee_auxiliary,
/// bayes_limit_health, bayes_limit_auxiliary, full_map_health, ..., reduced_map_health, ... (each {total, by_channel}),
/// worse_than_prior (health parameters), auxiliary_unit, row_space (orthonormal rows), reduction (in words), tuning,
/// certificate (certificate_json.h), without_sensor.
nlohmann::ordered_json design_as_json(const design::Design& design);

/// How the tuners were chosen, and why at all.
std::string reduction(const design::Design& design);

void print_design(const design::Design& design, std::ostream& out);

}  // namespace ehm::tuner_design
