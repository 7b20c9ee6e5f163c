// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design study faults --design D.json`: how well the monitor finds and names faults on the nonlinear engine.
// `tuner_design study false-alarms --design D.json`: how often it finds some where nothing is broken, on any engine.

#include <string>

#include "tuner_design/cli/command.h"
#include "tuner_design/faults/fault_study.h"
#include "tuner_design/faults/mission_fault_study.h"

namespace ehm::tuner_design {

struct FaultStudyArguments {
  std::string design;
  FaultStudyOptions options;
  bool process_noise = true;   ///< of the false-alarm study
  bool over_missions = false;  ///< faults: whole flights with the estimator of `mission` in place of the point
  MissionFaultOptions mission;
};

/// --design, --cases, --hours, --no-process-noise, --mission, --flights; seed and threads are the study command's.
void add_fault_study_options(CLI::App& command, FaultStudyArguments& arguments);

/// Flies, prints, and writes `csv` unless it is empty.
/// @throws files::FileError if the design file is bad or not for the nonlinear engine.
void fault_study_of_file(const FaultStudyArguments& arguments, const std::string& csv, const OutputOptions& output,
                         const Console& console);

/// The same for false alarms with nothing broken (false_alarm_study.h).
void false_alarm_study_of_file(const FaultStudyArguments& arguments, const std::string& csv,
                               const OutputOptions& output, const Console& console);

}  // namespace ehm::tuner_design
