// SPDX-License-Identifier: Apache-2.0
#pragma once
// The options that every command with a linear model has, for what a user's file may leave unstated.

#include <CLI/CLI.hpp>

#include "tuner_design/import/import_model.h"

namespace ehm::tuner_design {

/// What an option that names a model says about itself.
inline constexpr const char* model_help =
    "Linear model: ehm-linear-model/1 JSON, MATLAB v5 .mat, or a folder of CSV files";

/// --sample-time, --health-sigma, --sensor-noise, --process-noise.
void add_import_options(CLI::App& command, ImportOptions& options);

}  // namespace ehm::tuner_design
