// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design study NAME`: the tables of the papers, on our engine or a user's model; the studies of fault detection.

#include "tuner_design/cli/command.h"

namespace ehm::tuner_design {

/// Adds the subcommand to `app`; `run` is set to its action when the user chose it.
void add_study_command(CLI::App& app, Action& run);

}  // namespace ehm::tuner_design
