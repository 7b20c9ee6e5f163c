// SPDX-License-Identifier: Apache-2.0
#pragma once
// Operators' SimCommands in, what became of them out: to the log, and as CommandReply to whoever gave a request number.

#include <cstdint>

#include "engine_sim/scenario/scenario.h"
#include "engine_sim/simulated_engine.h"
#include "idl/dds/endpoint.h"

namespace ehm::engine_sim {

class CommandDesk {
 public:
  CommandDesk(idl::Participant& participant, const Scenario& scenario)
      : commands_(participant),
        replies_(participant),
        engine_id_(static_cast<std::uint32_t>(scenario.engine_id)),
        source_id_(static_cast<std::uint32_t>(scenario.source_id)) {}

  /// Applies and answers what has arrived for this engine.
  void serve(SimulatedEngine& engine);

 private:
  idl::Reader<SimCommand> commands_;
  idl::Writer<CommandReply> replies_;
  std::uint32_t engine_id_, source_id_;
};

}  // namespace ehm::engine_sim
