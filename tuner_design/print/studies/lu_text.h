// SPDX-License-Identifier: Apache-2.0
#pragma once
// The study of Lu's tables for people, for programs, and the paper's figures 3 to 8 as columns.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/lu/lu_study.h"

namespace ehm::tuner_design {

void print_lu_study(const LuStudy& study, std::ostream& out);
nlohmann::ordered_json lu_study_as_json(const LuStudy& study);
/// A line a sample of the first run: case, filter, time, estimates.
std::string lu_study_as_csv(const LuStudy& study);

}  // namespace ehm::tuner_design
