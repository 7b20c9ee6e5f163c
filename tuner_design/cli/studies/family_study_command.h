// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design study family`: every estimator of the monitor in every case (tuner_design/family/family_study.h).

#include "tuner_design/cli/command.h"
#include "tuner_design/family/family_study.h"

namespace ehm::tuner_design {

void add_family_study_options(CLI::App& command, FamilyOptions& options);

/// @throws CLI::ValidationError without a design file
void family_study(const std::string& design_file, const FamilyOptions& options, const std::string& csv,
                  const OutputOptions& output, const Console& console);

}  // namespace ehm::tuner_design
