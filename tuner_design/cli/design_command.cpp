// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/design_command.h"

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <ostream>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/long_work/parallel_for.h"
#include "monitor/design/design_file.h"
#include "tuner_design/cli/import_options.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/design/response_time.h"
#include "tuner_design/print/check_text.h"
#include "tuner_design/print/design_text.h"

namespace ehm::tuner_design {
namespace {

const std::map<std::string, design::Tuning> tunings{
    {"kalman", design::Tuning::kalman}, {"map", design::Tuning::map}, {"closed-form", design::Tuning::closed_form}};

struct Arguments {
  std::vector<std::string> models, outs;
  ImportOptions import;
  std::vector<double> point_weights;
  WeightArguments weights;
  design::DesignOptions options;
  std::optional<double> time_constant_s;
  unsigned threads = long_work::all_cores();
  OutputOptions output;
};

/// "name=number". @throws CLI::ValidationError if it is not.
std::pair<std::string, double> named_weight(const std::string& text) {
  const auto equals = text.find('=');
  double value = 0.0;
  if (equals == std::string::npos || !CLI::detail::lexical_cast(text.substr(equals + 1), value) || !(value >= 0.0) ||
      !std::isfinite(value)) {
    throw CLI::ValidationError("--weight", "'" + text + "' is not NAME=number, number 0 or above");
  }
  return {text.substr(0, equals), value};
}

void require_pairs(const Arguments& arguments) {
  const std::size_t models = arguments.models.size();
  if (arguments.outs.size() != models)
    throw CLI::ValidationError("--out", std::to_string(arguments.outs.size()) + " files for " + std::to_string(models) +
                                            " models; name one --out for each --model");
  if (!arguments.point_weights.empty() && arguments.point_weights.size() != models)
    throw CLI::ValidationError("--point-weight", std::to_string(arguments.point_weights.size()) + " weights for " +
                                                     std::to_string(models) + " models; give one for each, or none");
  std::vector<std::string> taken = arguments.models;
  for (const std::string& out : arguments.outs) {
    require_other_file("--out", out, taken);
    taken.push_back(out);
  }
}

std::vector<design::Design> designs_of(const Arguments& arguments, const std::vector<linear_model::LinearModel>& models,
                                       const Console& console) {
  long_work::ProgressBar bar = progress_bar(console, arguments.output, long_work::ProgressBar::shares);
  design::DesignOptions options = arguments.options;
  options.weights = weights_of(arguments.weights, models.front());
  std::vector<double> weights = arguments.point_weights;
  weights.resize(models.size(), 1.0);
  if (arguments.time_constant_s)
    options.qh_percent2 = qh_for_time_constant(models, weights, options, *arguments.time_constant_s);
  return design_envelope(models, weights, options, arguments.threads, [&](double share) { bar.show_share(share); });
}

void design_to_files(const Arguments& arguments, const Console& console) {
  require_pairs(arguments);
  std::vector<linear_model::LinearModel> models;
  std::vector<std::vector<std::string>> assumed;  // of each model
  std::string files;
  for (const std::string& path : arguments.models) {
    ImportedModel imported = import_model(path, arguments.import);
    models.push_back(std::move(imported.model));
    assumed.push_back(std::move(imported.assumed));
    files += (files.empty() ? "" : ", ") + path;
  }
  std::vector<design::Design> designs;
  try {
    designs = designs_of(arguments, models, console);
  } catch (const CLI::ValidationError&) {
    throw;
  } catch (const std::exception& error) {
    throw files::FileError(files + ": " + error.what());
  }
  for (std::size_t i = 0; i < designs.size(); ++i)
    designs[i].hash = design::write_design(designs[i], arguments.outs[i]);
  print_result(
      console, arguments.output,
      [&]() -> nlohmann::ordered_json {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (std::size_t i = 0; i < designs.size(); ++i) {
          all.push_back(design_as_json(designs[i]));
          all.back()["assumed"] = assumed[i];
        }
        if (all.size() == 1) return all.front();
        return {{"designs", std::move(all)}};
      },
      [&](std::ostream& out) {
        for (std::size_t i = 0; i < designs.size(); ++i) {
          print_design(designs[i], out);
          print_assumed(assumed[i], out);
          out << "  written to " << arguments.outs[i] << ", hash " << designs[i].hash << '\n';
        }
      });
}

}  // namespace

void add_weight_options(CLI::App& command, WeightArguments& arguments) {
  // Without any weight on health, directions of it are left free and its error grows without bound (theory.md, section 6).
  const auto weight = [&](const char* name, double& value, double least, const char* what) {
    command.add_option(name, value, what)->check(CLI::Range(least, 1e6))->capture_default_str();
  };
  weight("--weight-health", arguments.health, 1e-6, "Weight of SSEE(h) over its limit in the objective");
  weight("--weight-auxiliary", arguments.auxiliary, 0.0, "Weight of SSEE(z) over its limit in the objective");
  command.add_option("--weight", arguments.channels, "Weight of one auxiliary output within SSEE(z); repeatable")
      ->type_name("NAME=VALUE")
      ->check([](const std::string& text) {
        named_weight(text);
        return std::string();
      });
}

design::ErrorWeights weights_of(const WeightArguments& arguments, const linear_model::LinearModel& model) {
  design::ErrorWeights weights{arguments.health, arguments.auxiliary, {}};
  if (arguments.channels.empty()) return weights;
  weights.channel.assign(model.auxiliary.size(), 1.0);
  for (const std::string& text : arguments.channels) {
    const auto [name, value] = named_weight(text);
    std::string known;
    bool found = false;
    for (std::size_t i = 0; i < model.auxiliary.size(); ++i) {
      known += (known.empty() ? "" : ", ") + model.auxiliary[i].name;
      if (model.auxiliary[i].name != name) continue;
      weights.channel[i] = value;
      found = true;
    }
    if (!found)
      throw CLI::ValidationError("--weight", "the model has no auxiliary output '" + name + "'; it has: " + known);
  }
  return weights;
}

void add_qh_option(CLI::App& command, double& qh_percent2) {
  command
      .add_option("--qh", qh_percent2,
                  "Process noise of each health parameter, percent^2 per sample: larger is faster and noisier")
      ->capture_default_str()
      ->check([](const std::string& text) -> std::string {
        double value = 0.0;
        const bool good = CLI::detail::lexical_cast(text, value) && value >= 1e-12 && value <= 100.0;
        return good ? "" : "'" + text + "' is not a number from 1e-12 to 100 percent^2 per sample";
      });
}

void add_design_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  arguments->options.version = EHM_VERSION;
  CLI::App* command = app.add_subcommand("design", "Tuners, gains, error limits and certificate for a linear model");
  command
      ->add_option("--model", arguments->models,
                   std::string(model_help) + "; several are the points of an envelope, with one V* for all")
      ->required()
      ->type_name("MODEL");
  command->add_option("--out", arguments->outs, "Design file to write, one for each --model")
      ->required()
      ->type_name("D.json");
  command->add_option("--point-weight", arguments->point_weights, "Weight of each point of an envelope; default 1 each")
      ->check(CLI::Range(1e-6, 1e6));
  command
      ->add_option("--tuning", arguments->options.tuning,
                   "V* by search for the least error of the Kalman filter or of the MAP estimator, or H Ph as it is")
      ->transform(CLI::CheckedTransformer(tunings))
      ->type_name("kalman|map|closed-form")
      ->option_text("kalman|map|closed-form [kalman]");
  add_qh_option(*command, arguments->options.qh_percent2);
  command
      ->add_option("--time-constant-s", arguments->time_constant_s,
                   "Slowest time constant of the filter, s: finds --qh and V* together")
      ->check(CLI::Range(1e-3, 1e6))
      ->excludes("--qh");
  add_weight_options(*command, arguments->weights);
  add_import_options(*command, arguments->import);
  command->add_option("--starts", arguments->options.random_starts, "Random starts of the search, beside the two known")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  add_seed_option(*command, arguments->options.seed, "Of the random starts");
  command->add_option("--threads", arguments->threads, "The result does not depend on it; default: one a core")
      ->check(CLI::Range(1, 1024));
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { design_to_files(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
