// SPDX-License-Identifier: Apache-2.0
#pragma once
// The study of faults over whole flights: flights in which things break by turns, and flights in which nothing does
// (mission_fault.h), in the measures of SAE AIR4985:
//   detection rate    something was said while it was broken       mean time to detect
//   isolation rate    of those, the right sensor was named (for a component, a component)     mean time to diagnose
//   false alarms      a flight hour with nothing broken
// Shares have Wilson's 95 % intervals (J. Am. Stat. Assoc. 22 (1927) 209), counts Poisson's (false_alarm_study.h).
// The confusion of the study has as many of each fault as the table gives; weighted, as many as fail in the field:
// FaultRow::per_million_hours, assumed, since the papers state none.

#include <array>
#include <functional>

#include "tuner_design/faults/mission_fault.h"

namespace ehm::tuner_design {

struct MissionFaultOptions {
  std::size_t flights = 20;           ///< in which things break
  std::size_t fault_free = 15;        ///< of two hours
  std::string estimator = "onboard";  ///< published
  std::string engine_name;            ///< of estimator onboard: name or file; empty: the design's
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
};

struct Share {
  std::size_t part = 0, whole = 0;
  double value() const { return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole); }
  /// {lower, upper}
  std::array<double, 2> interval() const;
};

/// One row of the fault table in one moment of the flight.
struct MissionFaultRow {
  const FaultRow* row = nullptr;
  Moment moment = Moment::steady;
  std::size_t flown = 0, in_time = 0, detected = 0, right = 0;  ///< in_time: said within abrupt_limit_s
  std::size_t wrong_sensor = 0, component = 0, ambiguous = 0;   ///< of those that were not right
  double detect_s = 0.0, diagnose_s = 0.0;                      ///< mean, of detected, of right
};

struct MissionFaultStudy {
  MissionFaultOptions options;
  std::vector<MissionOutcome> flights;  ///< with faults
  std::vector<MissionFaultRow> rows;
  std::vector<std::string> failed;  ///< flights that ended early: which, and why
  std::size_t not_in_use = 0;       ///< slots that did not count
  double fault_free_hours = 0.0;
  std::size_t false_alarms = 0, alarms_between = 0;
  double between_hours = 0.0;
  // Of the flights with nothing broken, at the design's sample time:
  double sample_time_s = 0.0, estimated = 0.0, coverage = 0.0, ssee_landing = 0.0, claim_landing = 0.0;
};

/// Sum of the rows that `belongs` takes.
MissionFaultRow sum_of(const MissionFaultStudy& study, const std::function<bool(const MissionFaultRow&)>& belongs);

/// The same seed gives the same study on any number of threads.
/// @throws std::invalid_argument if the design is not for the engine, or has no such estimator.
MissionFaultStudy run_mission_fault_study(const design::Design& design, const MissionFaultOptions& options,
                                          const std::function<void(double share)>& progress);

}  // namespace ehm::tuner_design
