// SPDX-License-Identifier: Apache-2.0
#pragma once
// The start study for people and as JSON with the same numbers.

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "tuner_design/flight/start_study.h"

namespace ehm::tuner_design {

void print_start_study(const StartStudy& study, std::ostream& out);
nlohmann::ordered_json start_study_as_json(const StartStudy& study);

}  // namespace ehm::tuner_design
