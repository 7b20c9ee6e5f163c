// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/identify_command.h"

#include <memory>
#include <optional>

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/linear_model/model_file.h"
#include "monitor/design/design_file.h"
#include "tuner_design/cli/import_options.h"
#include "tuner_design/cli/recorded_engine.h"
#include "tuner_design/print/identify_text.h"

namespace ehm::tuner_design {
namespace {

struct Arguments {
  std::string recording, column_map, design, model, out;
  std::optional<std::int64_t> engine_id;
  ImportOptions import;
  OutputOptions output;
};

linear_model::LinearModel model_of(const Arguments& arguments) {
  if (arguments.design.empty() == arguments.model.empty())
    throw CLI::ValidationError("identify",
                               "needs one of --design and --model: what the recorded engine is compared with");
  if (arguments.design.empty()) return import_model(arguments.model, arguments.import).model;
  refuse_import_options(arguments.design, arguments.import);
  return design::read_design(arguments.design).model;
}

void identify(const Arguments& arguments, const Console& console) {
  const std::string& source = arguments.design.empty() ? arguments.model : arguments.design;
  const linear_model::LinearModel model = model_of(arguments);
  if (!arguments.out.empty()) require_other_file("--out", arguments.out, {source, arguments.recording});
  const RecordedEngine engine =
      read_recorded_engine(arguments.recording, arguments.column_map, arguments.engine_id, model);
  IdentifiedNoise noise;
  try {
    noise = identify_noise(engine.samples, model, monitor::ValidityOptions{});
  } catch (const std::invalid_argument& error) {
    throw files::FileError(arguments.recording + ": " + error.what());
  }
  if (!arguments.out.empty()) linear_model::write_model(with_identified_noise(model, noise), arguments.out);
  const IdentifySource named{arguments.recording, source, engine.engine_id, engine.not_accepted, arguments.out};
  print_result(
      console, arguments.output, [&] { return identified_as_json(noise, named); },
      [&](std::ostream& out) { print_identified(noise, named, out); });
}

}  // namespace

void add_identify_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "identify", "Noise of sensors (R) and of the engine's motion (Q) from a recording, with 95 % intervals");
  command->add_option("--recording", arguments->recording, "Recording of the monitor, or a CSV file with --column-map")
      ->required()
      ->type_name("FILE");
  command->add_option("--column-map", arguments->column_map, "Which column of the CSV file is which channel")
      ->type_name("MAP.toml");
  command->add_option("--design", arguments->design, "Design whose model the engine is compared with")
      ->type_name("D.json");
  command->add_option("--model", arguments->model, std::string(model_help) + "; in the place of --design")
      ->type_name("MODEL");
  command->add_option("--engine-id", arguments->engine_id, "Which engine, where the recording has several")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{4294967295}));
  command->add_option("--out", arguments->out, "Model to write, with what was identified as its noise")
      ->type_name("M.json");
  add_import_options(*command, arguments->import);
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { identify(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
