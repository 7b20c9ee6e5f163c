// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/fault_study_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

namespace ehm::tuner_design {
namespace {

/// Columns of the confusion matrix: the sensors, then these.
enum Column : std::size_t { component, ambiguous, slow_bias, nothing, columns_beside_sensors };

struct MatrixRow {
  std::string name;
  std::vector<std::size_t> counts;
};

std::size_t column(const FaultOutcome& outcome, std::size_t sensors) {
  switch (outcome.answer) {
    case Answer::sensor:
      return outcome.channel;
    case Answer::component:
      return sensors + component;
    case Answer::ambiguous:
      return sensors + ambiguous;
    case Answer::slow_bias:
      return sensors + slow_bias;
    case Answer::nothing:
      break;
  }
  return sensors + nothing;
}

/// What broke, channel by channel; all kinds of sensor fault in one row a sensor.
std::vector<MatrixRow> confusion(const FaultStudy& study) {
  const std::size_t sensors = study.sensors.size(), width = sensors + columns_beside_sensors;
  std::vector<MatrixRow> matrix;
  for (const auto& name : study.sensors) matrix.push_back({name, std::vector<std::size_t>(width)});
  for (const auto& name : study.health) matrix.push_back({name, std::vector<std::size_t>(width)});
  matrix.push_back({"nothing", std::vector<std::size_t>(width)});
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    if (!study.outcomes[i].flown) continue;
    const FaultCase& what = study.cases[i];
    const std::size_t row = what.row->broken == Broken::nothing     ? matrix.size() - 1
                            : what.row->broken == Broken::component ? sensors + what.channel
                                                                    : what.channel;
    ++matrix[row].counts[column(study.outcomes[i], sensors)];
  }
  return matrix;
}

std::vector<std::string> column_names(const FaultStudy& study) {
  std::vector<std::string> names = study.sensors;
  for (const char* name : {"component", "ambiguous", "slow bias", "nothing"}) names.emplace_back(name);
  return names;
}

const std::string& channel_name(const FaultStudy& study, bool health, std::size_t channel) {
  return health ? study.health[channel] : study.sensors[channel];
}

void print_figure(std::ostream& out, const char* what, double share, double asked) {
  out << fmt::format("  {:<58} {:6.1f} %   asked {:.0f} %\n", what, 100.0 * share, 100.0 * asked);
}

}  // namespace

void print_fault_study(const FaultStudy& study, std::ostream& out) {
  out << fmt::format("Fault study: {} cases on the nonlinear engine, {:.1f} hours with nothing broken\n\n",
                     study.cases.size(), study.fault_free_hours);
  out << fmt::format("  {:<20}{:>6}{:>9}{:>7}{:>13}{:>11}{:>11}{:>11}{:>8}{:>16}\n", "what broke", "cases", "in 3 s",
                     "right", "other sensor", "component", "ambiguous", "slow bias", "silent", "median delay, s");
  for (const FaultRowSummary& s : study.rows)
    out << fmt::format("  {:<20}{:>6}{:>9}{:>7}{:>13}{:>11}{:>11}{:>11}{:>8}{:>16.2f}\n", s.row->name, s.flown,
                       s.found_in_time, s.right, s.wrong_sensor, s.component, s.ambiguous, s.slow_bias, s.silent,
                       s.median_delay_s);

  out << fmt::format("\n  Confusion: rows what broke, columns what was said\n  {:<16}", "");
  for (const std::string& name : column_names(study)) out << fmt::format("{:>11}", name);
  out << '\n';
  for (const MatrixRow& row : confusion(study)) {
    out << fmt::format("  {:<16}", row.name);
    for (const std::size_t count : row.counts) out << fmt::format("{:>11}", count == 0 ? "." : std::to_string(count));
    out << '\n';
  }

  out << '\n';
  print_figure(out, "bias of 5 sigma: something said within 3 s", study.found, 0.95);
  print_figure(out, "bias of 5 sigma: right sensor", study.right_sensor, 0.90);
  print_figure(out, "bias of 5 sigma: ambiguous among those not right", study.ambiguous_of_rest, 0.50);
  print_figure(out, "component steps not called a sensor fault", study.component_not_sensor, 0.90);
  out << fmt::format(
             "  false alarms in {:.1f} fault-free hours: {} (asked: 3 in 30); in the cases before the fault: {}\n",
             study.fault_free_hours, study.false_alarms, study.early_alarms)
      << fmt::format("  largest step of a health estimate at a change of the sensor set: {:.2f} published sigmas\n",
                     study.largest_step_sigmas);
  if (study.not_flown > 0)
    out << fmt::format("  {} engines of the fleet fly too far off the design's point: estimates are withheld\n",
                       study.not_flown);
}

nlohmann::ordered_json fault_study_as_json(const FaultStudy& study) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array(), matrix = nlohmann::ordered_json::array();
  for (const FaultRowSummary& s : study.rows)
    rows.push_back({{"what_broke", s.row->name},
                    {"cases", s.flown},
                    {"found_in_3_s", s.found_in_time},
                    {"right", s.right},
                    {"other_sensor", s.wrong_sensor},
                    {"component", s.component},
                    {"ambiguous", s.ambiguous},
                    {"slow_bias", s.slow_bias},
                    {"silent", s.silent},
                    {"median_delay_s", s.median_delay_s}});
  for (const MatrixRow& row : confusion(study)) matrix.push_back({{"what_broke", row.name}, {"said", row.counts}});
  return {{"cases", study.cases.size()},
          {"found_in_3_s", study.found},
          {"right_sensor", study.right_sensor},
          {"ambiguous_of_rest", study.ambiguous_of_rest},
          {"component_not_sensor", study.component_not_sensor},
          {"fault_free_hours", study.fault_free_hours},
          {"false_alarms", study.false_alarms},
          {"early_alarms", study.early_alarms},
          {"largest_step_sigmas", study.largest_step_sigmas},
          {"not_flown", study.not_flown},
          {"rows", std::move(rows)},
          {"confusion_columns", column_names(study)},
          {"confusion", std::move(matrix)}};
}

std::string fault_study_as_csv(const FaultStudy& study) {
  std::string csv = "case,what_broke,channel,said,said_channel,delay_s,size,largest_step_sigmas,early_alarms\n";
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const FaultCase& what = study.cases[i];
    const FaultOutcome& o = study.outcomes[i];
    if (!o.flown) continue;
    const bool broken = what.row->broken != Broken::nothing;
    const bool said = o.answer != Answer::nothing;
    csv +=
        fmt::format("{},{},{},{},{},{},{:.6g},{:.4g},{}\n", i, what.row->name,
                    broken ? channel_name(study, what.row->broken == Broken::component, what.channel) : "",
                    name_of(o.answer), said ? channel_name(study, o.answer == Answer::component, o.channel) : "",
                    o.delay_s ? fmt::format("{:.3f}", *o.delay_s) : "", o.size, o.largest_step_sigmas, o.false_alarms);
  }
  return csv;
}

}  // namespace ehm::tuner_design
