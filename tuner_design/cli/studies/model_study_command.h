// SPDX-License-Identifier: Apache-2.0
#pragma once
// The studies of a linear model, our engine's at cruise unless the user names another:
//   simon-garg-4 to -7   tables of NASA/TM-2010-216077
//   robust               what a robust gain buys
// and what all studies of a model have in common.

#include <functional>
#include <string>

#include "tuner_design/cli/studies/study_outcome.h"
#include "tuner_design/import/import_model.h"
#include "tuner_design/robust/robust_study.h"
#include "tuner_design/studies/simon_garg.h"

namespace ehm::tuner_design {

/// Where our engine is linearised for these studies: the paper's cruise, new or half worn.
linear_model::LinearModel cruise_model(const std::shared_ptr<const engine_sim::EngineDefinition>& engine,
                                       bool half_worn);

/// The outcome of `run`, which in text and JSON says besides what the import has assumed of the model.
/// @throws files::FileError, with the file's or the model's name, for what `run` throws as std::invalid_argument
StudyOutcome of_model(const ImportedModel& model, const std::string& file, const std::function<StudyOutcome()>& run);

/// `options.table` is that of `name`.
StudyOutcome simon_garg_study(const std::string& name, SimonGargOptions options, const ImportedModel& model,
                              const std::string& file, const StudyProgress& progress);
StudyOutcome robust_study(const RobustStudyOptions& options, const ImportedModel& model, const std::string& file);

}  // namespace ehm::tuner_design
