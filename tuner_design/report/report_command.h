#pragma once
// tuner_design report DESIGN.json -o report.html [--csv-dir DIR]: a design explained on one self-contained page.

#include "tuner_design/command.h"

namespace ehm::bench {

void add_report_command(CLI::App& app, Action& run);

}  // namespace ehm::bench
