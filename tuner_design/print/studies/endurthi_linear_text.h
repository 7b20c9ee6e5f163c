// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables I to III of Endurthi's thesis: ours, with the tangent, beside what was published; for people, as JSON and CSV.
// JSON and CSV have every error of the study, whichever table was asked for.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/endurthi/linearisation_study.h"

namespace ehm::tuner_design {

/// `table`: 1, 2 or 3.
void print_linearisation_study(const endurthi::LinearisationStudy& study, int table, std::ostream& out);
nlohmann::ordered_json linearisation_study_as_json(const endurthi::LinearisationStudy& study);
std::string linearisation_study_csv(const endurthi::LinearisationStudy& study);

}  // namespace ehm::tuner_design
