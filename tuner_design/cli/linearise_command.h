// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design linearise`: the engine at one operating point becomes a linear model file.

#include "tuner_design/cli/command.h"

namespace ehm::tuner_design {

/// Adds the subcommand to `app`; `run` is set to its action when the user chose it.
void add_linearise_command(CLI::App& app, Action& run);

}  // namespace ehm::tuner_design
