// SPDX-License-Identifier: Apache-2.0
#pragma once
// The studies after Endurthi's thesis: endurthi-1 to -3, the 27 linear models against the nonlinear engine (tables I to
// III); endurthi-4 and -5, health by the filters on them (tables IV and V).

#include <string>

#include "tuner_design/cli/command.h"
#include "tuner_design/cli/studies/flight_study_command.h"
#include "tuner_design/endurthi/health_study.h"

namespace ehm::tuner_design {

struct EndurthiArguments {
  endurthi::HealthStudyOptions health;
};

bool is_endurthi_study(const std::string& study);

/// --p0, --wear-noise, --cycles-per-flight; engine, seed and threads are the study command's.
void add_endurthi_options(CLI::App& command, EndurthiArguments& arguments);

/// Runs and prints; `csv`: a file to write besides, or empty.
void endurthi_study(const std::string& study, const EndurthiArguments& arguments, const StudyGiven& given,
                    const std::string& csv, const OutputOptions& output, const Console& console);

}  // namespace ehm::tuner_design
