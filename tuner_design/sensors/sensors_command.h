#pragma once
// `tuner_design sensors MODEL`: which of the model's sensors are worth having, by cost against accuracy.

#include "tuner_design/command.h"

namespace ehm::bench {

/// Adds the subcommand to the command line; once it is parsed, `run` does the work.
void add_sensors_command(CLI::App& app, Action& run);

}  // namespace ehm::bench
