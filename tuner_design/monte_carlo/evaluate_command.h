#pragma once
// tuner_design evaluate DESIGN.json: theory beside experiment, on the linear truth, the nonlinear engine, or both.

#include "tuner_design/command.h"

namespace ehm::bench {

void add_evaluate_command(CLI::App& app, Action& run);

}  // namespace ehm::bench
