// SPDX-License-Identifier: Apache-2.0
#pragma once
// Engines by name: those that are compiled in, so that a name means the same engine on every machine. Their files are
// deploy/engines/NAME.json.

#include <memory>
#include <string>
#include <vector>

#include "engine_sim/engines/engine_definition.h"

namespace ehm::engine_sim {

const std::vector<std::string>& shipped_engine_list();
/// "jt9d, ...", for messages and help.
std::string shipped_engine_names();

/// The shipped engine of this name, or the one in this file: what holds a '/' or a '.' is a path.
/// @throws files::FileError if there is no engine of this name (the message lists them), or the file has a defect
std::shared_ptr<const EngineDefinition> named_engine(const std::string& name_or_file);

}  // namespace ehm::engine_sim
