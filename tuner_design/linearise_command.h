#pragma once
// `tuner_design linearise`: the engine at one operating point becomes a linear model file.

#include "tuner_design/command.h"

namespace ehm::bench {

/// Adds the subcommand to `app`; `run` is set to its action when the user chose it.
void add_linearise_command(CLI::App& app, Action& run);

}  // namespace ehm::bench
