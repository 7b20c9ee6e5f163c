// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design study lu-4` to `lu-9`: the tables of Lu, Huang & Lv on an engine of ours (tuner_design/lu/lu_study.h).

#include "tuner_design/cli/command.h"
#include "tuner_design/cli/studies/study_outcome.h"
#include "tuner_design/lu/lu_study.h"

namespace ehm::tuner_design {

void add_lu_study_options(CLI::App& command, LuOptions& options);

/// The table that `name` ends with. As CSV: the estimates of the first run.
StudyOutcome lu_study(const std::string& name, LuOptions options, const StudyGiven& given,
                      const StudyProgress& progress);

}  // namespace ehm::tuner_design
