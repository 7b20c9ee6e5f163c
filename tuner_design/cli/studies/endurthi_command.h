// SPDX-License-Identifier: Apache-2.0
#pragma once
// The studies after Endurthi's thesis: endurthi-1 to -3, the 27 linear models against the nonlinear engine (tables I to
// III); endurthi-4 and -5, health by the filters on them (tables IV and V).

#include <string>

#include "tuner_design/cli/command.h"
#include "tuner_design/cli/studies/study_outcome.h"
#include "tuner_design/endurthi/health_study.h"

namespace ehm::tuner_design {

struct EndurthiArguments {
  endurthi::HealthStudyOptions health;
};

/// --p0, --wear-noise, --cycles-per-flight; engine, seed and threads are the study command's.
void add_endurthi_options(CLI::App& command, EndurthiArguments& arguments);

/// endurthi-1 to -3; all three tables have one result.
StudyOutcome endurthi_linear_study(const std::string& name, const StudyGiven& given, const StudyProgress& progress);
/// endurthi-4 and -5; both tables have one result.
StudyOutcome endurthi_health_study(const std::string& name, const EndurthiArguments& arguments, const StudyGiven& given,
                                   const StudyProgress& progress);
StudyOutcome endurthi_pendulum_study(const StudyGiven& given);
StudyOutcome endurthi_turbofan_study(const EndurthiArguments& arguments, const StudyGiven& given);

}  // namespace ehm::tuner_design
