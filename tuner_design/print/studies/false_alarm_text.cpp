// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/false_alarm_text.h"

#include <fmt/format.h>

#include <ostream>

namespace ehm::tuner_design {

void print_false_alarms(const FalseAlarmStudy& study, std::ostream& out) {
  out << fmt::format("False alarms: {} engines of the fleet with nothing broken, {:.0f} s each, {:.1f} h, {}\n",
                     study.flights, study.flight_s, study.hours,
                     study.process_noise ? "with process noise w" : "without process noise");
  out << fmt::format("  {:<30} {:>12} {:>8} {:>12} {:>23}  {}\n", "event", "stated, 1/h", "events", "measured, 1/h",
                     "95 % interval, 1/h", "stated rate");
  for (const FalseAlarmRow& row : study.rows)
    out << fmt::format("  {:<30} {:>12.4g} {:>8} {:>13.4g} {:>11.4g} to {:>8.4g}  {}\n", row.kind, row.stated_per_hour,
                       row.events, row.per_hour, row.lower_per_hour, row.upper_per_hour,
                       row.holds() ? "holds" : "does not hold");
  out << fmt::format("  samples without estimates: {}\n", study.withheld);
}

nlohmann::ordered_json false_alarms_as_json(const FalseAlarmStudy& study) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const FalseAlarmRow& row : study.rows)
    rows.push_back({{"event", row.kind},
                    {"stated_per_hour", row.stated_per_hour},
                    {"events", row.events},
                    {"per_hour", row.per_hour},
                    {"lower_per_hour", row.lower_per_hour},
                    {"upper_per_hour", row.upper_per_hour},
                    {"holds", row.holds()}});
  return {{"flights", study.flights},
          {"flight_s", study.flight_s},
          {"hours", study.hours},
          {"process_noise", study.process_noise},
          {"samples_withheld", study.withheld},
          {"rows", std::move(rows)}};
}

std::string false_alarms_as_csv(const FalseAlarmStudy& study) {
  std::string text = "event,stated_per_hour,events,hours,per_hour,lower_per_hour,upper_per_hour,holds\n";
  for (const FalseAlarmRow& row : study.rows)
    text += fmt::format("{},{},{},{},{},{},{},{}\n", row.kind, row.stated_per_hour, row.events, study.hours,
                        row.per_hour, row.lower_per_hour, row.upper_per_hour, row.holds() ? 1 : 0);
  return text;
}

}  // namespace ehm::tuner_design
