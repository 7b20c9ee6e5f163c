// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/commands.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "deploy/runtime/config/man_page.h"
#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/files/file_error.h"
#include "tuner_design/cli/baselines_command.h"
#include "tuner_design/cli/command.h"
#include "tuner_design/cli/design_command.h"
#include "tuner_design/cli/envelope_command.h"
#include "tuner_design/cli/evaluate_command.h"
#include "tuner_design/cli/identify_command.h"
#include "tuner_design/cli/import_command.h"
#include "tuner_design/cli/import_options.h"
#include "tuner_design/cli/linearise_command.h"
#include "tuner_design/cli/report_command.h"
#include "tuner_design/cli/sensors_command.h"
#include "tuner_design/cli/studies/study_command.h"
#include "tuner_design/cli/sweep_command.h"
#include "tuner_design/print/check_text.h"

namespace ehm::tuner_design {
namespace {

constexpr const char* footer =
    "Exit codes: 0 done, 1 a computation failed, 2 wrong command line or input file; the reason is on stderr.";
constexpr const char* purpose =
    "Offline bench of the engine health monitor: from an engine to the filter that flies.\n"
    "Chain: linearise (or your own matrices: JSON, .mat, CSV) -> design -> the file that monitor loads.";

struct CheckArguments {
  std::string file;
  ImportOptions import;
  OutputOptions output;
};

void check_one(const CheckArguments& arguments, const Console& console) {
  const CheckedFile file = check_file(arguments.file, arguments.import);
  print_result(
      console, arguments.output, [&] { return check_as_json(file); },
      [&](std::ostream& out) { print_check(file, out); });
  require_observable(file, arguments.file);
}

void add_check_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand("check", "Validate a linear model or a design file and say what it is");
  command->add_option("file", arguments->file, "A design, or a linear model as JSON, .mat or CSV folder")
      ->required()
      ->type_name("FILE");
  add_import_options(*command, arguments->import);
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { check_one(*arguments, console); }; });
}

}  // namespace

int run_tuner_design(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Action run;
  CLI::App app(purpose, "tuner_design");
  app.set_version_flag("--version", std::string("tuner_design ") + EHM_VERSION);
  app.require_subcommand(1);
  app.footer(footer);
  add_linearise_command(app, run);
  add_import_command(app, run);
  add_identify_command(app, run);
  add_design_command(app, run);
  add_envelope_command(app, run);
  add_check_command(app, run);
  add_baselines_command(app, run);
  add_sweep_command(app, run);
  add_sensors_command(app, run);
  add_evaluate_command(app, run);
  add_study_command(app, run);
  add_report_command(app, run);
  config::add_man_flag(app, {.app = &app});
  const std::string command = argc > 1 ? argv[1] : "";
  const auto known = app.get_subcommands([&](const CLI::App* sub) { return sub->get_name() == command; });
  if (!command.empty() && command.front() != '-' && known.empty()) {
    std::vector<std::string> commands;
    for (const CLI::App* sub : app.get_subcommands({})) commands.push_back(sub->get_name());
    err << config::unknown_command("tuner_design", command, commands);
    return 2;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return config::usage_answer(app, error, out, err);
  }
  try {
    run({out, err});
    return 0;
  } catch (const CLI::Error& error) {  // what only the files could tell about the command line
    err << "tuner_design: " << error.what() << '\n';
    return 2;
  } catch (const files::FileError& error) {
    err << "tuner_design: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    err << "tuner_design: " << error.what() << '\n';
    return 1;
  }
}

}  // namespace ehm::tuner_design
