// SPDX-License-Identifier: Apache-2.0
#pragma once
// tuner_design envelope: a design with a schedule of point models, for the monitor's estimator `scheduled`; of an
// engine, or of a user's models at several points.

#include "tuner_design/cli/command.h"

namespace ehm::tuner_design {

void add_envelope_command(CLI::App& app, Action& run);

}  // namespace ehm::tuner_design
