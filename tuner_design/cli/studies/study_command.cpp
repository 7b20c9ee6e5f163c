// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/study_command.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <ostream>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/long_work/parallel_for.h"
#include "tuner_design/cli/design_command.h"
#include "tuner_design/cli/studies/study_table.h"
#include "tuner_design/report/study_sections/study_page.h"

namespace ehm::tuner_design {
namespace {

struct Arguments : StudyArguments {
  std::string csv, html;
  std::string command_line;  ///< what of it makes the numbers
  OutputOptions output;
};

/// Options that make no difference to the numbers.
constexpr std::array beside_the_numbers{"--csv", "--html", "--threads", "--json", "--progress", "--quiet"};

std::string command_line_of(const CLI::App& command) {
  std::string text = "tuner_design " + command.get_name();
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || std::ranges::count(beside_the_numbers, name) > 0) continue;
    if (!option->get_positional()) text += " " + name;
    if (option->get_items_expected_max() == 0) continue;  // a switch
    for (const std::string& value : option->results()) text += " " + value;
  }
  return text;
}

void require_what_it_has(const Arguments& arguments, const StudyKind& kind) {
  const std::string study = arguments.study;
  if (!arguments.csv.empty() && !kind.has_csv)
    throw CLI::ValidationError("--csv", "does not go with " + study + "; --json has every number");
  if (!arguments.html.empty() && !kind.has_page)
    throw CLI::ValidationError("--html",
                               "does not go with " + study + ", which has no page yet; --json has every number");
  if (!study.starts_with("simon-garg") && study != "robust" && arguments.trim != "new")
    throw CLI::ValidationError("--trim",
                               "goes with simon-garg-4 to -7; study " + study + " flies the design of --design");
}

/// One of the files to write: no input, nor the other one.
void require_own_file(const std::string& option, const std::string& file, const Arguments& arguments) {
  std::vector<std::string> inputs;
  for (const std::string& input : {arguments.model, arguments.faults.design, arguments.flight.schedule})
    if (!input.empty()) inputs.push_back(input);
  require_other_file(option, file, inputs);
}

void run_study(const Arguments& arguments, const Console& console) {
  const StudyKind& kind = study_kind(arguments.study);
  require_what_it_has(arguments, kind);
  if (!arguments.csv.empty()) require_own_file("--csv", arguments.csv, arguments);
  std::optional<files::AtomicFile> page;  // opened before the work, which may take hours
  if (!arguments.html.empty()) {
    require_own_file("--html", arguments.html, arguments);
    if (!arguments.csv.empty()) require_other_file("--html", arguments.html, {arguments.csv});
    page.emplace(arguments.html);
  }
  const StudyOutcome outcome = [&] {
    long_work::ProgressBar bar = progress_bar(console, arguments.output, long_work::ProgressBar::shares);
    return kind.run(arguments, [&](double share) { bar.show_share(share); });
  }();
  if (!arguments.csv.empty()) files::write_file_atomically(arguments.csv, outcome.as_csv());
  if (page) {
    page->write(report::to_html(
        report::study_page(outcome.section(), {arguments.command_line, EHM_VERSION, arguments.options.seed})));
    page->commit();
  }
  print_result(console, arguments.output, outcome.as_json, outcome.print);
}

}  // namespace

void add_study_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  SimonGargOptions& options = arguments->options;
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
      ->check(CLI::IsMember(study_names()));
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
  command
      ->add_option("--html", arguments->html,
                   "Write tables and figures to this file too, as a page that needs nothing else")
      ->type_name("F.html");
  command->add_option("--threads", options.threads, "The result does not depend on it; default: one a core")
      ->check(CLI::Range(1, 1024));
  add_import_options(*command, arguments->import);
  add_output_options(*command, arguments->output);
  command->callback([arguments, runs, command, &run] {
    arguments->command_line = command_line_of(*command);
    if (runs->count() > 0) arguments->kosanam.runs = static_cast<int>(arguments->options.runs);
    run = [arguments](const Console& console) { run_study(*arguments, console); };
  });
}

}  // namespace ehm::tuner_design
