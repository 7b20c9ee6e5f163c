// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design import IN --out M.json`: a user's matrices as an ehm-linear-model/1 file. Says dimensions, units, how
// each channel is scaled, and what was assumed. A model that no design can be made of is refused, and nothing is
// written.

#include <CLI/CLI.hpp>

#include "tuner_design/cli/command.h"

namespace ehm::tuner_design {

void add_import_command(CLI::App& app, Action& run);

}  // namespace ehm::tuner_design
