// SPDX-License-Identifier: Apache-2.0
#pragma once
// The false-alarm study (false_alarm_study.h) as a table, as JSON and as CSV: a row a kind of event, the stated rate
// beside the measured one and its 95 % interval.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/faults/false_alarm_study.h"

namespace ehm::tuner_design {

void print_false_alarms(const FalseAlarmStudy& study, std::ostream& out);
nlohmann::ordered_json false_alarms_as_json(const FalseAlarmStudy& study);
std::string false_alarms_as_csv(const FalseAlarmStudy& study);

}  // namespace ehm::tuner_design
