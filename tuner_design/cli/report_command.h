// SPDX-License-Identifier: Apache-2.0
#pragma once
// tuner_design report DESIGN.json -o report.html [--csv-dir DIR] [--studies NAME,NAME|all]: a design explained on one
// self-contained page.

#include "tuner_design/cli/command.h"

namespace ehm::tuner_design {

void add_report_command(CLI::App& app, Action& run);

}  // namespace ehm::tuner_design
