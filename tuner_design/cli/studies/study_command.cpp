// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/study_command.h"

#include <memory>
#include <ostream>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/long_work/parallel_for.h"
#include "tuner_design/cli/design_command.h"
#include "tuner_design/cli/engine_option.h"
#include "tuner_design/cli/import_options.h"
#include "tuner_design/cli/studies/endurthi_command.h"
#include "tuner_design/cli/studies/family_study_command.h"
#include "tuner_design/cli/studies/fault_study_command.h"
#include "tuner_design/cli/studies/flight_study_command.h"
#include "tuner_design/cli/studies/kosanam_command.h"
#include "tuner_design/cli/studies/lu_study_command.h"
#include "tuner_design/kosanam/mapss_model.h"
#include "tuner_design/linearise/linearise.h"
#include "tuner_design/print/check_text.h"
#include "tuner_design/print/studies/robust_study_text.h"
#include "tuner_design/robust/robust_study.h"
#include "tuner_design/studies/half_worn.h"
#include "tuner_design/studies/simon_garg_table.h"

namespace ehm::tuner_design {
namespace {

struct Arguments {
  std::string study, model, csv, trim = "new";
  ImportOptions import;
  SimonGargOptions options;
  FaultStudyArguments faults;
  FlightStudyArguments flight;
  RobustStudyOptions robust;
  KosanamArguments kosanam;
  LuOptions lu;
  FamilyOptions family;
  EndurthiArguments endurthi;
  EngineOption engine;
  OutputOptions output;
};

/// The paper's operating point on our engine: cruise, tangent at the new engine, or as the paper has it at the average
/// of a fleet that is half worn.
linear_model::LinearModel cruise(const EngineOption& engine, bool half_worn) {
  LineariseOptions options;
  options.flight = {10668.0, 0.8, 0.0};
  options.demand = {engine_sim::DemandKind::t40_k, cruise_t40_k};
  options.fleet = 0;
  if (half_worn) options.health = half_worn_health;
  linear_model::LinearModel model = linearise(engine.engine(), options).model;
  model.name += half_worn ? ", linearised at a half-worn engine (3000 cycles), as the paper's is"
                          : ", linearised at the new engine (the paper's: half worn)";
  return model;
}

/// The model of --model, or the engine's at cruise.
ImportedModel model_of(const Arguments& arguments) {
  return arguments.model.empty() ? ImportedModel{cruise(arguments.engine, arguments.trim == "half-worn"), "", {}}
                                 : import_model(arguments.model, arguments.import);
}

/// A study of a model, with what the import has assumed of it.
template <class Study>
void print_of_model(const Arguments& arguments, const Console& console, const ImportedModel& imported,
                    const Study& study, nlohmann::ordered_json (*as_json)(const Study&),
                    void (*print)(const Study&, std::ostream&)) {
  print_result(
      console, arguments.output,
      [&] {
        nlohmann::ordered_json json = as_json(study);
        json["assumed"] = imported.assumed;
        return json;
      },
      [&](std::ostream& out) {
        print(study, out);
        print_assumed(imported.assumed, out);
      });
}

void run_robust(const Arguments& arguments, const Console& console) {
  if (!arguments.csv.empty()) throw CLI::ValidationError("--csv", "does not go with robust; --json has every number");
  const ImportedModel imported = model_of(arguments);
  RobustStudy study;
  try {
    study = run_robust_study(imported.model, arguments.robust);
  } catch (const std::invalid_argument& error) {
    throw files::FileError((arguments.model.empty() ? "" : arguments.model + ": ") + error.what());
  }
  print_of_model(arguments, console, imported, study, robust_study_as_json, print_robust_study);
}

void run_kosanam(const Arguments& arguments, const Console& console) {
  const ImportedModel model =
      arguments.model.empty() ? ImportedModel{mapss_model(), "", {}} : import_model(arguments.model, arguments.import);
  kosanam_study(arguments.kosanam,
                {arguments.study, arguments.model, arguments.csv, model, arguments.options.seed,
                 static_cast<unsigned>(arguments.options.threads)},
                arguments.output, console);
}

void run_study(Arguments arguments, const Console& console) {
  arguments.faults.options.seed = arguments.options.seed;
  arguments.faults.options.threads = arguments.options.threads;
  arguments.faults.options.engine = arguments.engine.engine();
  arguments.faults.mission.engine_name = arguments.engine.name_or_file;
  const bool of_the_paper = arguments.study.starts_with("simon-garg");
  if (arguments.study == "robust") {
    arguments.robust.qh_percent2 = arguments.options.qh_percent2;
    return run_robust(arguments, console);
  }
  if (!of_the_paper && arguments.trim != "new")
    throw CLI::ValidationError(
        "--trim", "goes with simon-garg-4 to -7; study " + arguments.study + " flies the design of --design");
  if (is_kosanam_study(arguments.study)) return run_kosanam(arguments, console);
  if (is_endurthi_study(arguments.study))
    return endurthi_study(arguments.study, arguments.endurthi,
                          {arguments.engine.engine(), arguments.options.seed, arguments.options.threads}, arguments.csv,
                          arguments.output, console);
  if (is_flight_study(arguments.study)) {
    if (!arguments.csv.empty())
      throw CLI::ValidationError("--csv", "does not go with " + arguments.study + "; --json has every number");
    return flight_study(arguments.study, arguments.flight,
                        {arguments.engine.engine(), arguments.options.seed, arguments.options.threads},
                        arguments.output, console);
  }
  if (arguments.study == "family") {
    arguments.family.engine = arguments.engine.engine();
    arguments.family.estimator.engine = arguments.engine.name_or_file;
    arguments.family.seed = arguments.options.seed;
    arguments.family.threads = arguments.options.threads;
    arguments.family.engines = arguments.flight.fleet.value_or(arguments.family.engines);
    return family_study(arguments.faults.design, arguments.family, arguments.csv, arguments.output, console);
  }
  if (arguments.study.starts_with("lu-")) {
    arguments.lu.engine = arguments.engine.engine();
    arguments.lu.seed = arguments.options.seed;
    arguments.lu.threads = arguments.options.threads;
    return lu_study(arguments.study, arguments.lu, arguments.csv, arguments.output, console);
  }
  if (arguments.study == "faults")
    return fault_study_of_file(arguments.faults, arguments.csv, arguments.output, console);
  if (arguments.study == "false-alarms")
    return false_alarm_study_of_file(arguments.faults, arguments.csv, arguments.output, console);
  arguments.options.table = arguments.study.back() - '0';
  const ImportedModel imported = model_of(arguments);
  SimonGargStudy study;
  try {
    long_work::ProgressBar bar = progress_bar(console, arguments.output, long_work::ProgressBar::shares);
    study = run_simon_garg(imported.model, arguments.options, [&](double share) { bar.show_share(share); });
  } catch (const std::invalid_argument& error) {
    throw files::FileError((arguments.model.empty() ? "" : arguments.model + ": ") + error.what());
  }
  if (!arguments.csv.empty()) {
    require_other_file("--csv", arguments.csv, {arguments.model});
    files::write_file_atomically(arguments.csv, study_csv(study));
  }
  print_of_model(arguments, console, imported, study, study_as_json, print_study);
}

}  // namespace

void add_study_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  SimonGargOptions& options = arguments->options;
  options.threads = long_work::all_cores();
  CLI::App* command = app.add_subcommand("study",
                                         "Tables 4 to 7 of Simon & Garg, NASA/TM-2010-216077, on our engine; "
                                         "how well the monitor finds and names faults; its false alarms; "
                                         "estimates over whole flights; whether every engine starts; "
                                         "the EGT margin over its life; "
                                         "the tuner filter at points from approach to take-off; "
                                         "what a robust gain buys; "
                                         "every estimator in every case; "
                                         "the tables of Kosanam's thesis: constrained and robust filters; "
                                         "tables I to V of Endurthi's thesis on linearisation; "
                                         "or tables 4 to 9 of Lu, Huang & Lv on particle filters");
  command
      ->add_option("study", arguments->study,
                   "Which table, faults, false-alarms, flight, starts, margin, points, robust, family, "
                   "kosanam-5.1 to -5.3, kosanam-ga, endurthi-1 to -5, "
                   "endurthi-ukf-pendulum, endurthi-ukf-turbofan, or lu-4 to -9")
      ->required()
      ->check(CLI::IsMember({"simon-garg-4",
                             "simon-garg-5",
                             "simon-garg-6",
                             "simon-garg-7",
                             "faults",
                             "false-alarms",
                             "flight",
                             "starts",
                             "margin",
                             "points",
                             "robust",
                             "family",
                             "lu-4",
                             "lu-5",
                             "lu-6",
                             "lu-7",
                             "lu-8",
                             "lu-9",
                             "kosanam-5.1",
                             "kosanam-5.2",
                             "kosanam-5.3",
                             "kosanam-ga",
                             "endurthi-1",
                             "endurthi-2",
                             "endurthi-3",
                             "endurthi-4",
                             "endurthi-5",
                             "endurthi-ukf-pendulum",
                             "endurthi-ukf-turbofan"}));
  CLI::Option* model = command
                           ->add_option("--model", arguments->model,
                                        std::string(model_help) + "; default: our engine at cruise, of kosanam MAPSS")
                           ->type_name("MODEL");
  command
      ->add_option("--trim", arguments->trim,
                   "simon-garg: where our engine is linearised, new, or half worn as in the paper; not with --model")
      ->check(CLI::IsMember({"new", "half-worn"}))
      ->capture_default_str()
      ->excludes(model);
  add_engine_option(
      *command, arguments->engine,
      "Engine of simon-garg and robust without --model, faults, flight, starts, margin, points, family, endurthi, lu");
  add_qh_option(*command, options.qh_percent2);
  command->add_option("--engines", options.engines, "Engines of the MAP estimators")
      ->check(CLI::Range(std::size_t{100}, std::size_t{100'000'000}))
      ->capture_default_str();
  CLI::Option* runs =
      command->add_option("--runs", options.runs, "Runs of 30 s of the Kalman filter; of kosanam engines, default 30")
          ->check(CLI::Range(std::size_t{10}, std::size_t{1'000'000}))
          ->capture_default_str();
  add_kosanam_options(*command, arguments->kosanam);
  add_fault_study_options(*command, arguments->faults);
  add_flight_study_options(*command, arguments->flight);
  add_lu_study_options(*command, arguments->lu);
  add_family_study_options(*command, arguments->family);
  add_endurthi_options(*command, arguments->endurthi);
  command
      ->add_option("--nominal-loss", arguments->robust.nominal_loss,
                   "robust: what the gain may cost where nothing is wrong, share of the mean error")
      ->check(CLI::Range(1e-4, 10.0))
      ->capture_default_str();
  command
      ->add_option("--noise-factor", arguments->robust.noise_factor,
                   "robust: of the sensors' variance where it is wrong")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  add_seed_option(*command, options.seed, "Of the random starts and of the experiments");
  command->add_option("--csv,--out", arguments->csv, "Write the table (faults: a line a case) to this file too")
      ->type_name("F.csv");
  command->add_option("--threads", options.threads, "The result does not depend on it; default: one a core")
      ->check(CLI::Range(1, 1024));
  add_import_options(*command, arguments->import);
  add_output_options(*command, arguments->output);
  command->callback([arguments, runs, &run] {
    if (runs->count() > 0) arguments->kosanam.runs = static_cast<int>(arguments->options.runs);
    run = [arguments](const Console& console) { run_study(*arguments, console); };
  });
}

}  // namespace ehm::tuner_design
