// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/model_study_command.h"

#include <ostream>
#include <stdexcept>

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/scenario/life.h"
#include "tuner_design/linearise/linearise.h"
#include "tuner_design/print/check_text.h"
#include "tuner_design/print/studies/robust_study_text.h"
#include "tuner_design/report/study_sections/study_sections.h"
#include "tuner_design/studies/simon_garg_table.h"

namespace ehm::tuner_design {
namespace {

/// "Fleet average, 50 percent deteriorated": the trim at which Simon & Garg linearise.
constexpr double half_life_cycles = 3000.0;

}  // namespace

linear_model::LinearModel cruise_model(const std::shared_ptr<const engine_sim::EngineDefinition>& engine,
                                       bool half_worn) {
  LineariseOptions options;
  options.flight = {10668.0, 0.8, 0.0};
  options.demand = {engine_sim::DemandKind::t40_k, cruise_t40_k};
  options.fleet = 0;
  if (half_worn) options.health = engine_sim::health_of({.cycles = half_life_cycles});
  linear_model::LinearModel model = linearise(engine, options).model;
  model.name += half_worn ? ", linearised at a half-worn engine (3000 cycles), as the paper's is"
                          : ", linearised at the new engine (the paper's: half worn)";
  return model;
}

StudyOutcome of_model(const ImportedModel& model, const std::string& file, const std::function<StudyOutcome()>& run) {
  StudyOutcome outcome;
  try {
    outcome = run();
  } catch (const std::invalid_argument& error) {
    throw files::FileError((file.empty() ? model.model.name : file) + ": " + error.what());
  }
  outcome.print = [print = outcome.print, assumed = model.assumed](std::ostream& out) {
    print(out);
    print_assumed(assumed, out);
  };
  outcome.as_json = [as_json = outcome.as_json, assumed = model.assumed] {
    nlohmann::ordered_json json = as_json();
    json["assumed"] = assumed;
    return json;
  };
  return outcome;
}

StudyOutcome simon_garg_study(const std::string& name, SimonGargOptions options, const ImportedModel& model,
                              const std::string& file, const StudyProgress& progress) {
  options.table = name.back() - '0';
  return of_model(model, file, [&] {
    return outcome_of(run_simon_garg(model.model, options, progress),
                      {print_study, study_as_json, study_csv, report::simon_garg_section});
  });
}

StudyOutcome robust_study(const RobustStudyOptions& options, const ImportedModel& model, const std::string& file) {
  return of_model(model, file, [&] {
    return outcome_of(run_robust_study(model.model, options),
                      {print_robust_study, robust_study_as_json, {}, report::robust_section});
  });
}

}  // namespace ehm::tuner_design
