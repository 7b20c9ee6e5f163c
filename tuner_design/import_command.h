#pragma once
// `tuner_design import IN --out M.json`: a user's matrices as an ehm-linear-model/1 file. Says dimensions, units, how
// each channel is scaled, and what was assumed. A model that no design can be made of is refused, and nothing is
// written.

#include <CLI/CLI.hpp>

#include "tuner_design/command.h"

namespace ehm::bench {

void add_import_command(CLI::App& app, Action& run);

}  // namespace ehm::bench
