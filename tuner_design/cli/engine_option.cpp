// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/engine_option.h"

#include "engine_sim/engines/shipped_engines.h"

namespace ehm::tuner_design {

std::shared_ptr<const engine_sim::EngineDefinition> EngineOption::engine() const {
  return engine_sim::named_engine(name_or_file);
}

void add_engine_option(CLI::App& command, EngineOption& option, const std::string& what) {
  command
      .add_option("--engine", option.name_or_file,
                  what + ": a shipped one (" + engine_sim::shipped_engine_names() + ") or an engine file")
      ->type_name("NAME|FILE")
      ->capture_default_str();
}

}  // namespace ehm::tuner_design
