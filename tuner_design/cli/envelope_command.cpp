// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/envelope_command.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <ostream>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/long_work/parallel_for.h"
#include "monitor/design/design_file.h"
#include "tuner_design/cli/engine_option.h"
#include "tuner_design/cli/import_options.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/envelope/envelope.h"
#include "tuner_design/linearise/linearise.h"
#include "tuner_design/print/envelope_text.h"

namespace ehm::tuner_design {
namespace {

struct Arguments {
  std::string out;
  EngineOption engine;
  EnvelopeOptions envelope;
  std::vector<std::string> models, variables;
  double error_of_slopes = 0.02;
  ImportOptions import;
  OutputOptions output;
};

/// Where the tuner filter watches, of the engine: cruise.
linear_model::LinearModel cruise_model(const Arguments& arguments) {
  LineariseOptions options;
  options.flight = {10668.0, 0.8, 0.0};
  options.demand = {engine_sim::DemandKind::t40_k, cruise_t40_k};
  options.method = LineariseMethod::fleet;
  options.seed = arguments.envelope.node.seed;
  return linearise(arguments.engine.engine(), options).model;
}

std::vector<schedule::Variable> variables_of(const Arguments& arguments) {
  std::vector<schedule::Variable> variables;
  for (const std::string& name : arguments.variables) {
    const auto known = std::find(std::begin(schedule::variable_names), std::end(schedule::variable_names), name);
    variables.push_back(static_cast<schedule::Variable>(known - std::begin(schedule::variable_names)));
  }
  return variables;
}

design::DesignOptions design_options() {
  design::DesignOptions options;
  options.version = EHM_VERSION;
  options.created_by = "tuner_design envelope";
  return options;
}

EnvelopeResult of_models(const Arguments& arguments, std::vector<linear_model::LinearModel>& models) {
  std::string files;
  for (const std::string& path : arguments.models) {
    models.push_back(import_model(path, arguments.import).model);
    files += (files.empty() ? "" : ", ") + path;
  }
  EnvelopeResult result;
  try {
    result.schedule = schedule_of_models(models, variables_of(arguments), arguments.error_of_slopes);
  } catch (const std::invalid_argument& error) {
    throw files::FileError(files + ": " + error.what());
  }
  result.valid = models.size();
  return result;
}

void make_envelope(Arguments arguments, const Console& console) {
  const bool of_engine = arguments.models.empty();
  if (of_engine && !arguments.variables.empty())
    throw CLI::ValidationError("--variables", "goes with --models; an engine's are n1_corrected_rpm, mach and t2_k");
  if (!of_engine && arguments.variables.empty()) arguments.variables = {schedule::variable_names[0]};
  long_work::ProgressBar bar = progress_bar(console, arguments.output, long_work::ProgressBar::shares);
  std::vector<linear_model::LinearModel> models;
  EnvelopeResult result;
  if (of_engine) {
    arguments.envelope.engine = arguments.engine.engine();
    result = engine_envelope(arguments.envelope, [&](double share) { bar.show_share(share); });
    models.push_back(cruise_model(arguments));
  } else {
    result = of_models(arguments, models);
  }
  design::Design design = design_tuner(models.front(), design_options(), arguments.envelope.threads);
  design.schedule = result.schedule;
  design.hash = design::write_design(design, arguments.out);
  print_result(
      console, arguments.output, [&] { return envelope_as_json(result, design); },
      [&](std::ostream& out) {
        print_envelope(result, design, out);
        out << "  written to " << arguments.out << ", hash " << design.hash << '\n';
      });
}

}  // namespace

void add_envelope_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  arguments->envelope.threads = long_work::all_cores();
  CLI::App* command = app.add_subcommand(
      "envelope",
      "A design with point models over the whole envelope, for estimator scheduled: of an engine, or of "
      "models of yours");
  command->add_option("--out", arguments->out, "Design file to write")->required()->type_name("D.json");
  add_engine_option(*command, arguments->engine, "Engine whose envelope it is");
  command
      ->add_option("--nodes", arguments->envelope.most_nodes,
                   "At most so many points; they go where interpolation misses most")
      ->check(CLI::Range(42, 5000))
      ->capture_default_str();
  command->add_option("--fleet", arguments->envelope.node.fleet, "Engines that each point's derivatives are fitted to")
      ->check(CLI::Range(20, 10000))
      ->capture_default_str();
  auto* models = command
                     ->add_option("--models", arguments->models,
                                  std::string(model_help) +
                                      ", one for each point, in place of an engine; the first is "
                                      "where the tuner filter watches")
                     ->type_name("MODEL");
  command
      ->add_option("--variables", arguments->variables,
                   "With --models: what the points are looked up by; default n1_corrected_rpm")
      ->check(CLI::IsMember({"n1_corrected_rpm", "mach", "t2_k", "altitude_m"}))
      ->delimiter(',');
  command
      ->add_option("--slope-error", arguments->error_of_slopes,
                   "With --models: share by which a point's slopes by health may be wrong, where it states no "
                   "linearisation_error")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  static_cast<void>(models);
  add_seed_option(*command, arguments->envelope.node.seed, "Of the fleet");
  command->add_option("--threads", arguments->envelope.threads, "The result does not depend on it; default: one a core")
      ->check(CLI::Range(1, 1024));
  add_import_options(*command, arguments->import);
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { make_envelope(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
