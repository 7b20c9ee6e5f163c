// SPDX-License-Identifier: Apache-2.0
#pragma once
// --engine NAME|FILE: which nonlinear engine a subcommand flies.

#include <CLI/CLI.hpp>
#include <memory>

#include "engine_sim/engines/engine_definition.h"

namespace ehm::tuner_design {

struct EngineOption {
  std::string name_or_file = "jt9d";

  /// @throws files::FileError if there is no such engine, or its file has a defect
  std::shared_ptr<const engine_sim::EngineDefinition> engine() const;
};

/// `what`: of the option's description, "Engine to linearise".
void add_engine_option(CLI::App& command, EngineOption& option, const std::string& what);

}  // namespace ehm::tuner_design
