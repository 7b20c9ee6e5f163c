// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design design`: one linear model, or several of one envelope, become design files.

#include "monitor/design/design.h"
#include "tuner_design/cli/command.h"

namespace ehm::tuner_design {

/// What --weight-health, --weight-auxiliary and --weight NAME=VALUE of a command line say.
struct WeightArguments {
  double health = 1.0, auxiliary = 1.0;
  std::vector<std::string> channels;
};

void add_weight_options(CLI::App& command, WeightArguments& arguments);

/// @throws CLI::ValidationError if a name is no auxiliary output of the model.
design::ErrorWeights weights_of(const WeightArguments& arguments, const linear_model::LinearModel& model);

/// --qh with its range.
void add_qh_option(CLI::App& command, double& qh_percent2);

/// Adds the subcommand to `app`; `run` is set to its action when the user chose it.
void add_design_command(CLI::App& app, Action& run);

}  // namespace ehm::tuner_design
