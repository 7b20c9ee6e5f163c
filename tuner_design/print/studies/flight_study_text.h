// SPDX-License-Identifier: Apache-2.0
#pragma once
// The flight study for people and as JSON with the same numbers.

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "tuner_design/flight/flight_figures.h"

namespace ehm::tuner_design {

void print_flight_study(const FlightStudy& study, std::ostream& out);
nlohmann::ordered_json flight_study_as_json(const FlightStudy& study);

}  // namespace ehm::tuner_design
