#include "tuner_design/commands.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <ostream>

#include "monitor/design/design_file.h"
#include "monitor/design/file_error.h"
#include "monitor/design/model_file.h"
#include "tuner_design/check_report.h"
#include "tuner_design/command.h"
#include "tuner_design/design_report.h"
#include "tuner_design/design_tuner.h"
#include "tuner_design/linearise_command.h"
#include "tuner_design/report/report_command.h"

namespace ehm::bench {
namespace {

constexpr const char* footer =
    "Exit codes: 0 done, 1 a computation failed, 2 wrong command line or input file; the reason is on stderr.\n"
    "Chain: linearise (or your own matrices) -> design -> the file that monitor loads.";

struct DesignArguments {
  std::string model, out;
  design::DesignOptions options;
  OutputOptions output;
};

void design_to_file(const DesignArguments& arguments, const Console& console) {
  const estimation::LinearModel model = design::read_model(arguments.model);
  std::error_code absent;
  if (std::filesystem::equivalent(arguments.model, arguments.out, absent))
    throw design::FileError(arguments.out + ": --out is the model itself; name another file for the design");
  design::Design design;
  try {
    design = design_tuner(model, arguments.options);
  } catch (const std::runtime_error& error) {
    throw design::FileError(arguments.model + ": " + error.what());
  }
  design.hash = design::write_design(design, arguments.out);
  print_result(
      console, arguments.output, [&] { return design_as_json(design); },
      [&](std::ostream& out) {
        print_design(design, out);
        out << "  written to " << arguments.out << ", hash " << design.hash << '\n';
      });
}

void add_design_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<DesignArguments>();
  arguments->options.version = EHM_VERSION;
  CLI::App* command = app.add_subcommand("design", "Tuner, gains and error limits for a linear model");
  command->add_option("--model", arguments->model, "Linear model file (ehm-linear-model/1)")
      ->required()
      ->type_name("M.json");
  command->add_option("--out", arguments->out, "Design file to write")->required()->type_name("D.json");
  command
      ->add_option("--qh", arguments->options.qh_percent2,
                   "Process noise of each health parameter, percent^2 per sample: larger is faster and noisier")
      ->capture_default_str()
      ->check([](const std::string& text) -> std::string {
        double value = 0.0;
        const bool good = CLI::detail::lexical_cast(text, value) && value >= 1e-12 && value <= 100.0;
        return good ? "" : "'" + text + "' is not a number from 1e-12 to 100 percent^2 per sample";
      });
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { design_to_file(*arguments, console); }; });
}

struct CheckArguments {
  std::string file;
  OutputOptions output;
};

void check_one(const CheckArguments& arguments, const Console& console) {
  const CheckedFile file = check_file(arguments.file);
  print_result(
      console, arguments.output, [&] { return check_as_json(file); },
      [&](std::ostream& out) { print_check(file, out); });
  try {
    require_observable(file.observability, file.model.sensors.size() < file.model.health.size());
  } catch (const std::runtime_error& error) {
    throw design::FileError(arguments.file + ": " + error.what());
  }
}

void add_check_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand("check", "Validate a linear model or a design file and say what it is");
  command->add_option("file", arguments->file, "Linear model or design file")->required()->type_name("FILE");
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { check_one(*arguments, console); }; });
}

}  // namespace

int run_tuner_design(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Action run;
  CLI::App app("Offline bench of the engine health monitor: from an engine to the filter that flies.", "tuner_design");
  app.set_version_flag("--version", std::string("tuner_design ") + EHM_VERSION);
  app.require_subcommand(1);
  app.footer(footer);
  add_linearise_command(app, run);
  add_design_command(app, run);
  add_check_command(app, run);
  add_report_command(app, run);
  const std::string command = argc > 1 ? argv[1] : "";
  const auto known = app.get_subcommands([&](const CLI::App* sub) { return sub->get_name() == command; });
  if (!command.empty() && command.front() != '-' && known.empty()) {
    err << "tuner_design: unknown command '" << command << "'; allowed are linearise, design, check, report\n";
    return 2;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, out, err) == 0 ? 0 : 2;
  }
  try {
    run({out, err});
    return 0;
  } catch (const design::FileError& error) {
    err << "tuner_design: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    err << "tuner_design: " << error.what() << '\n';
    return 1;
  }
}

}  // namespace ehm::bench
