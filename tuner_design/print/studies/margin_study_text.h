// SPDX-License-Identifier: Apache-2.0
#pragma once
// The margin study for people and as JSON with the same numbers.

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "tuner_design/flight/margin_study.h"

namespace ehm::tuner_design {

void print_margin_study(const MarginStudy& study, std::ostream& out);
nlohmann::ordered_json margin_study_as_json(const MarginStudy& study);

}  // namespace ehm::tuner_design
