// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/evaluate_command.h"

#include <memory>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "monitor/design/design_file.h"
#include "tuner_design/cli/engine_option.h"
#include "tuner_design/print/evaluation_text.h"

namespace ehm::tuner_design {
namespace {

struct Arguments {
  std::string design, csv, truth = "linear", estimator = "both", hold = "fan-speed";
  EvaluateOptions options;
  EngineOption engine;
  OutputOptions output;
};

Evaluation evaluated(const design::Design& design, const Arguments& arguments, const Console& console) {
  long_work::ProgressBar bar = progress_bar(console, arguments.output, long_work::ProgressBar::shares);
  try {
    return evaluate(design, arguments.options, [&](double share) { bar.show_share(share); });
  } catch (const std::invalid_argument& error) {
    throw files::FileError(arguments.design + ": " + error.what());
  }
}

void evaluate_file(Arguments arguments, const Console& console) {
  EvaluateOptions& options = arguments.options;
  options.linear = arguments.truth != "nonlinear";
  options.nonlinear = arguments.truth != "linear";
  options.hold = arguments.hold == "fuel-flow" ? Hold::fuel_flow : Hold::fan_speed;
  options.kalman = arguments.estimator != "map";
  options.map = arguments.estimator != "kalman";
  options.engine = arguments.engine.engine();
  const design::Design design = design::read_design(arguments.design);
  const Evaluation evaluation = evaluated(design, arguments, console);
  if (!arguments.csv.empty()) {
    require_other_file("--csv", arguments.csv, {arguments.design});
    files::write_file_atomically(arguments.csv, evaluation_as_csv(evaluation, design));
  }
  print_result(
      console, arguments.output, [&] { return evaluation_as_json(evaluation, design, options); },
      [&](std::ostream& out) { print_evaluation(evaluation, design, options, out); });
}

}  // namespace

void add_evaluate_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  EvaluateOptions& options = arguments->options;
  CLI::App* command = app.add_subcommand("evaluate", "Monte Carlo: the design's estimators beside their theory");
  command->add_option("design", arguments->design, "Design file")->required()->type_name("DESIGN.json");
  command
      ->add_option("--truth", arguments->truth,
                   "What flies: the design's linear model, the nonlinear engine at its operating point, or both")
      ->check(CLI::IsMember({"linear", "nonlinear", "both"}))
      ->capture_default_str();
  add_engine_option(*command, arguments->engine, "Of the nonlinear truth; the design must be for it");
  command->add_option("--estimator", arguments->estimator, "The monitor's Kalman filter, MAP on one snapshot, or both")
      ->check(CLI::IsMember({"kalman", "map", "both"}))
      ->capture_default_str();
  command
      ->add_option("--hold", arguments->hold,
                   "On the nonlinear truth: fan speed as the control holds it, fuel flow known to the filter; or fuel "
                   "flow at trim")
      ->check(CLI::IsMember({"fan-speed", "fuel-flow"}))
      ->capture_default_str();
  command->add_option("--runs", options.runs, "Engines that the Kalman filter flies on")
      ->check(CLI::Range(2, 100000000))
      ->capture_default_str();
  command->add_option("--engines", options.engines, "Engines of the MAP estimators")
      ->check(CLI::Range(2, 100000000))
      ->capture_default_str();
  command->add_option("--seconds", options.seconds, "Length of a run from a cold start, s")
      ->check(CLI::Range(1e-3, 86400.0))
      ->capture_default_str();
  command->add_option("--window", options.window, "Last part of a run, over which errors are averaged, s")
      ->check(CLI::Range(1e-3, 86400.0))
      ->capture_default_str();
  add_seed_option(*command, options.seed, "Of engines and noise");
  command->add_option("--threads", options.threads, "The result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag(
      "--process-noise,!--no-process-noise", options.process_noise,
      "The engine that the Kalman filter flies on moves by the model's process noise (the default), or is "
      "in balance; the theory beside it is that of the same engine");
  command
      ->add_option("--wear", options.wear,
                   "The engines that the Kalman filter flies on are worn so many times wider than the fleet: does the "
                   "published sigma grow with them?")
      ->check(CLI::Range(0.01, 20.0))
      ->capture_default_str();
  command->add_option("--csv", arguments->csv, "Also write the numbers to this file")->type_name("FILE");
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { evaluate_file(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
