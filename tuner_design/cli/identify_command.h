// SPDX-License-Identifier: Apache-2.0
#pragma once
// tuner_design identify --recording FILE: the noise of sensors and engine from a recording, beside the model's.

#include "tuner_design/cli/command.h"

namespace ehm::tuner_design {

void add_identify_command(CLI::App& app, Action& run);

}  // namespace ehm::tuner_design
