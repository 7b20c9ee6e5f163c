// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design baselines DESIGN`: a design beside everything it is to be compared with.

#include "tuner_design/cli/command.h"

namespace ehm::tuner_design {

/// Adds the subcommand to the command line; once it is parsed, `run` does the work.
void add_baselines_command(CLI::App& app, Action& run);

}  // namespace ehm::tuner_design
