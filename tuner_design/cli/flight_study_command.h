// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design study flight`: the on-board estimator over whole flights, against truths that differ from its model.

#include "tuner_design/cli/command.h"
#include "tuner_design/flight/flight_figures.h"

namespace ehm::tuner_design {

/// --fleet, --step; engine, seed and threads are the study command's.
void add_flight_study_options(CLI::App& command, FlightStudyOptions& options);

/// Flies and prints.
void flight_study(const FlightStudyOptions& options, const OutputOptions& output, const Console& console);

}  // namespace ehm::tuner_design
