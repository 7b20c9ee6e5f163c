// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/kosanam_command.h"

#include <ostream>
#include <stdexcept>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "tuner_design/print/check_text.h"
#include "tuner_design/print/studies/kosanam_text.h"

namespace ehm::tuner_design {
namespace {

template <class Study>
void finish(const Study& study, const KosanamGiven& given, const OutputOptions& output, const Console& console,
            std::string (*csv)(const Study&), nlohmann::ordered_json (*json)(const Study&),
            void (*print)(const Study&, std::ostream&)) {
  if (!given.csv.empty()) {
    require_other_file("--csv", given.csv, {given.model_file});
    files::write_file_atomically(given.csv, csv(study));
  }
  print_result(
      console, output,
      [&] {
        nlohmann::ordered_json result = json(study);
        result["assumed"] = given.model.assumed;
        return result;
      },
      [&](std::ostream& out) {
        print(study, out);
        print_assumed(given.model.assumed, out);
      });
}

BatchOptions batch_of(const KosanamArguments& arguments, const KosanamGiven& given, BatchOptions batch) {
  batch.runs = arguments.runs.value_or(batch.runs);
  batch.flights = arguments.flights.value_or(batch.flights);
  batch.equal_wear_percent = arguments.equal_wear_percent;
  batch.seed = given.seed;
  batch.threads = given.threads;
  return batch;
}

}  // namespace

bool is_kosanam_study(const std::string& study) {
  return study.starts_with("kosanam");
}

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

void kosanam_study(KosanamArguments arguments, const KosanamGiven& given, const OutputOptions& output,
                   const Console& console) {
  if (given.study == "kosanam-ga") {
    arguments.search.seed = given.seed;
    return finish(search_gains(arguments.search), given, output, console, gain_search_csv, gain_search_as_json,
                  print_gain_search);
  }
  try {
    if (given.study == "kosanam-5.1") {
      ConstrainedTablesOptions options;
      options.batch = batch_of(arguments, given, options.batch);
      long_work::ProgressBar bar = progress_bar(console, output, long_work::ProgressBar::shares);
      const ConstrainedTables tables =
          constrained_tables(given.model.model, options, [&](double share) { bar.show_share(share); });
      return finish(tables, given, output, console, constrained_tables_csv, constrained_tables_as_json,
                    print_constrained_tables);
    }
    arguments.robust.batch = batch_of(arguments, given, arguments.robust.batch);
    finish(robust_tables(given.model.model, arguments.robust), given, output, console, robust_tables_csv,
           robust_tables_as_json, print_robust_tables);
  } catch (const std::invalid_argument& error) {
    throw files::FileError((given.model_file.empty() ? given.model.model.name : given.model_file) + ": " +
                           error.what());
  }
}

}  // namespace ehm::tuner_design
