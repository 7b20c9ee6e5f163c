// SPDX-License-Identifier: Apache-2.0
#pragma once
// The family study for people, for programs, and as columns for a plot.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/family/family_study.h"

namespace ehm::tuner_design {

void print_family_study(const FamilyStudy& study, std::ostream& out);
nlohmann::ordered_json family_study_as_json(const FamilyStudy& study);
/// A line for each estimator in each case.
std::string family_study_as_csv(const FamilyStudy& study);

}  // namespace ehm::tuner_design
