// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design sensors MODEL`: which of the model's sensors are worth having, by cost against accuracy.

#include "tuner_design/cli/command.h"

namespace ehm::tuner_design {

/// Adds the subcommand to the command line; once it is parsed, `run` does the work.
void add_sensors_command(CLI::App& app, Action& run);

}  // namespace ehm::tuner_design
