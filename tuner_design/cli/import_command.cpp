// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/import_command.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <memory>
#include <ostream>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/model_file.h"
#include "engine_sim/linear_model/scaling.h"
#include "tuner_design/cli/import_options.h"
#include "tuner_design/print/check_text.h"

namespace ehm::tuner_design {
namespace {

using linear_model::Channel;

struct Arguments {
  std::string in, out;
  ImportOptions options;
  OutputOptions output;
};

/// A channel list with what one scaled unit is: value = scale * scaled value.
struct ScaledList {
  const char* kind;
  const std::vector<Channel>& channels;
  const std::vector<Channel>& scaled;  ///< carries the scaled units
  Eigen::VectorXd scale;
};

std::vector<ScaledList> scaled_lists(const linear_model::LinearModel& model, const linear_model::LinearModel& scaled,
                                     const linear_model::Scaling& scaling) {
  return {{"state", model.states, scaled.states, scaling.state},
          {"control", model.controls, scaled.controls, Eigen::VectorXd::Ones(as_index(model.controls.size()))},
          {"health", model.health, scaled.health, scaling.health},
          {"sensor", model.sensors, scaled.sensors, scaling.sensor},
          {"auxiliary", model.auxiliary, scaled.auxiliary, scaling.auxiliary}};
}

nlohmann::ordered_json as_json(const CheckedFile& file, const std::vector<ScaledList>& lists, const std::string& out) {
  nlohmann::ordered_json json = check_as_json(file);
  json["scaling"] = nlohmann::ordered_json::array();
  for (const ScaledList& list : lists) {
    for (std::size_t i = 0; i < list.channels.size(); ++i) {
      json["scaling"].push_back({{"kind", list.kind},
                                 {"name", list.channels[i].name},
                                 {"unit", list.channels[i].unit},
                                 {"trim", list.channels[i].trim},
                                 {"scale", list.scale(as_index(i))},
                                 {"scaled_unit", list.scaled[i].unit}});
    }
  }
  json["file"] = out;
  return json;
}

void print_scaling(const std::vector<ScaledList>& lists, std::ostream& out) {
  std::size_t width = 4;
  for (const ScaledList& list : lists) {
    for (const Channel& channel : list.channels) width = std::max(width, channel.name.size());
  }
  const auto name_width = static_cast<int>(width);
  out << "  scaling        each value divided by its scale before anything is computed\n"
      << "    " << std::left << std::setw(11) << "channel" << std::setw(name_width) << "name" << std::right
      << std::setw(14) << "trim" << std::setw(14) << "scale"
      << "  unit -> scaled unit\n";
  for (const ScaledList& list : lists) {
    for (std::size_t i = 0; i < list.channels.size(); ++i) {
      out << "    " << std::left << std::setw(11) << list.kind << std::setw(name_width) << list.channels[i].name
          << std::right << std::setw(14) << list.channels[i].trim << std::setw(14) << list.scale(as_index(i)) << "  "
          << list.channels[i].unit << " -> " << list.scaled[i].unit << '\n';
    }
  }
}

void import_to_file(const Arguments& arguments, const Console& console) {
  const CheckedFile file = check_file(arguments.in, arguments.options);
  if (file.kind == "design") {
    throw files::FileError(arguments.in +
                           ": is a design; allowed: a linear model. Its model is the key \"model\" in it.");
  }
  std::error_code absent;
  if (std::filesystem::equivalent(arguments.in, arguments.out, absent))
    throw files::FileError(arguments.out + ": --out is the model itself; name another file");
  require_observable(file, arguments.in);
  linear_model::write_model(file.model, arguments.out);
  const linear_model::Scaling scaling = linear_model::scaling_of(file.model);
  const linear_model::LinearModel scaled = linear_model::scaled(file.model, scaling);
  const std::vector<ScaledList> lists = scaled_lists(file.model, scaled, scaling);
  print_result(
      console, arguments.output, [&] { return as_json(file, lists, arguments.out); },
      [&](std::ostream& out) {
        print_check(file, out);
        print_scaling(lists, out);
        out << "  written to " << arguments.out << '\n';
      });
}

}  // namespace

void add_import_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("import", "Your own matrices as a linear model file");
  command->add_option("model", arguments->in, model_help)->required()->type_name("IN");
  command->add_option("--out", arguments->out, "Linear model file to write")->required()->type_name("M.json");
  add_import_options(*command, arguments->options);
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { import_to_file(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
