// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design study faults --design D.json`: how well the monitor finds and names faults on the nonlinear engine.
// `tuner_design study false-alarms --design D.json`: how often it finds some where nothing is broken, on any engine.

#include <string>

#include "tuner_design/cli/command.h"
#include "tuner_design/cli/studies/study_outcome.h"
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

/// @throws CLI::ValidationError without a design file, files::FileError if it is bad or not for the nonlinear engine
StudyOutcome fault_study(const FaultStudyArguments& arguments, const StudyGiven& given, const StudyProgress& progress);

/// The same for false alarms with nothing broken (false_alarm_study.h).
StudyOutcome false_alarm_study(const FaultStudyArguments& arguments, const StudyGiven& given,
                               const StudyProgress& progress);

}  // namespace ehm::tuner_design
