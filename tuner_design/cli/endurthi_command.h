// SPDX-License-Identifier: Apache-2.0
#pragma once
// The studies after Endurthi's thesis: endurthi-1 to -3, the 27 linear models against the nonlinear engine (tables I to
// III); endurthi-4 and -5, health by the filters on them (tables IV and V).

#include <string>

#include "tuner_design/cli/command.h"
#include "tuner_design/cli/flight_study_command.h"

namespace ehm::tuner_design {

bool is_endurthi_study(const std::string& study);

/// Runs and prints; `csv`: a file to write besides, or empty.
void endurthi_study(const std::string& study, const StudyGiven& given, const std::string& csv,
                    const OutputOptions& output, const Console& console);

}  // namespace ehm::tuner_design
