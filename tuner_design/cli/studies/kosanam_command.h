// SPDX-License-Identifier: Apache-2.0
#pragma once
// `study kosanam-5.1`, `-5.2`, `-5.3` and `kosanam-ga`: the tables of Kosanam's thesis, on the MAPSS model unless
// another is named.

#include <optional>
#include <string>

#include "tuner_design/cli/command.h"
#include "tuner_design/cli/studies/study_outcome.h"
#include "tuner_design/import/import_model.h"
#include "tuner_design/kosanam/gain_search.h"
#include "tuner_design/kosanam/robust_tables.h"

namespace ehm::tuner_design {

struct KosanamArguments {
  std::optional<int> flights, runs;
  double equal_wear_percent = 0.0;
  RobustTablesOptions robust;
  GainSearchOptions search;
};

void add_kosanam_options(CLI::App& command, KosanamArguments& arguments);

/// kosanam-5.1. `model_file`: what `model` was read from, or empty.
/// @throws files::FileError if the model is not one that the study can fly, as kosanam_robust_study does
StudyOutcome kosanam_constrained_study(const KosanamArguments& arguments, const ImportedModel& model,
                                       const std::string& model_file, const StudyGiven& given,
                                       const StudyProgress& progress);
/// kosanam-5.2 and -5.3: one result.
StudyOutcome kosanam_robust_study(const KosanamArguments& arguments, const ImportedModel& model,
                                  const std::string& model_file, const StudyGiven& given);
/// kosanam-ga: on a vehicle; of the model it only says what was assumed.
StudyOutcome kosanam_search_study(const KosanamArguments& arguments, const ImportedModel& model,
                                  const std::string& model_file, const StudyGiven& given);

}  // namespace ehm::tuner_design
