// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design study family`: every estimator of the monitor in every case (tuner_design/family/family_study.h).

#include <string>

#include "tuner_design/cli/command.h"
#include "tuner_design/cli/studies/study_outcome.h"
#include "tuner_design/family/family_study.h"

namespace ehm::tuner_design {

void add_family_study_options(CLI::App& command, FamilyOptions& options);

/// @throws CLI::ValidationError without a design file, files::FileError if it is bad or of another engine
StudyOutcome family_study(const std::string& design_file, FamilyOptions options, const StudyGiven& given,
                          const StudyProgress& progress);

}  // namespace ehm::tuner_design
