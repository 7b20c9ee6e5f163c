// SPDX-License-Identifier: Apache-2.0
#pragma once
// tuner_design evaluate DESIGN.json: theory beside experiment, on the linear truth, the nonlinear engine, or both.

#include "tuner_design/cli/command.h"

namespace ehm::tuner_design {

void add_evaluate_command(CLI::App& app, Action& run);

}  // namespace ehm::tuner_design
