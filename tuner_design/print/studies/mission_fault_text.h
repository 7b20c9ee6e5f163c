// SPDX-License-Identifier: Apache-2.0
#pragma once
// The study of faults over whole flights for people and as JSON with the same numbers.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/faults/mission_fault_study.h"

namespace ehm::tuner_design {

void print_mission_fault_study(const MissionFaultStudy& study, std::ostream& out);
nlohmann::ordered_json mission_fault_study_as_json(const MissionFaultStudy& study);
/// A line a fault: flight,onset_s,moment,what_broke,channel,said,said_channel,delay_s,named_s,size
std::string mission_fault_study_as_csv(const MissionFaultStudy& study);

}  // namespace ehm::tuner_design
