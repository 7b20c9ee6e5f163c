// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/kosanam_command.h"

#include "tuner_design/cli/studies/model_study_command.h"
#include "tuner_design/print/studies/kosanam_text.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design {
namespace {

BatchOptions batch_of(const KosanamArguments& arguments, const StudyGiven& given, BatchOptions batch) {
  batch.runs = arguments.runs.value_or(batch.runs);
  batch.flights = arguments.flights.value_or(batch.flights);
  batch.equal_wear_percent = arguments.equal_wear_percent;
  batch.seed = given.seed;
  batch.threads = given.threads;
  return batch;
}

}  // namespace

void add_kosanam_options(CLI::App& command, KosanamArguments& arguments) {
  command
      .add_option("--batches", arguments.flights,
                  "kosanam: flights of a run, a batch of samples each; default 500, of 5.2 and 5.3 50")
      ->check(CLI::Range(2, 100'000));
  command
      .add_option("--equal-wear", arguments.equal_wear_percent,
                  "kosanam: percent that every health parameter wears over the flights; 0: the wear table's")
      ->check(CLI::Range(0.0, 20.0))
      ->capture_default_str();
  command.add_option("--eta", arguments.robust.eta, "kosanam-5.2, -5.3: share of the standard gain in the mixed one")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.add_option("--rho2", arguments.robust.rho2, "kosanam-5.2, -5.3: rho2 over rho1, per percent^2 of health")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command.add_option("--evaluations", arguments.search.evaluations, "kosanam-ga: of the search")
      ->check(CLI::Range(10, 1'000'000))
      ->capture_default_str();
}

StudyOutcome kosanam_constrained_study(const KosanamArguments& arguments, const ImportedModel& model,
                                       const std::string& model_file, const StudyGiven& given,
                                       const StudyProgress& progress) {
  ConstrainedTablesOptions options;
  options.batch = batch_of(arguments, given, options.batch);
  return of_model(model, model_file, [&] {
    return outcome_of(
        constrained_tables(model.model, options, progress),
        {print_constrained_tables, constrained_tables_as_json, constrained_tables_csv, report::constrained_section});
  });
}

StudyOutcome kosanam_robust_study(const KosanamArguments& arguments, const ImportedModel& model,
                                  const std::string& model_file, const StudyGiven& given) {
  RobustTablesOptions options = arguments.robust;
  options.batch = batch_of(arguments, given, options.batch);
  return of_model(model, model_file, [&] {
    return outcome_of(robust_tables(model.model, options),
                      {print_robust_tables, robust_tables_as_json, robust_tables_csv, report::robust_tables_section});
  });
}

StudyOutcome kosanam_search_study(const KosanamArguments& arguments, const ImportedModel& model,
                                  const std::string& model_file, const StudyGiven& given) {
  GainSearchOptions options = arguments.search;
  options.seed = given.seed;
  return of_model(model, model_file, [&] {
    return outcome_of(search_gains(options),
                      {print_gain_search, gain_search_as_json, gain_search_csv, report::gain_search_section});
  });
}

}  // namespace ehm::tuner_design
