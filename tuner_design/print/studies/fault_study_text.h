// SPDX-License-Identifier: Apache-2.0
#pragma once
// The fault study for people, as JSON, and as CSV with a line a case.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/faults/fault_study.h"

namespace ehm::tuner_design {

void print_fault_study(const FaultStudy& study, std::ostream& out);
nlohmann::ordered_json fault_study_as_json(const FaultStudy& study);
std::string fault_study_as_csv(const FaultStudy& study);

}  // namespace ehm::tuner_design
