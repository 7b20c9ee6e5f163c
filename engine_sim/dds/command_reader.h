#pragma once
// Operators' SimCommands, applied to the simulation between two samples; what is out of range is refused and said.

#include <functional>
#include <string>

#include "engine_sim/simulated_engine.h"
#include "idl/dds/endpoint.h"

namespace ehm::engine {

/// Applies one command at the engine's present time.
/// @throws std::invalid_argument naming field, value and allowed range, or why this engine cannot follow it.
void apply(const SimCommand& command, SimulatedEngine& engine);

class CommandReader {
 public:
  CommandReader(wire::Participant& participant, std::uint32_t engine_id)
      : reader_(participant), engine_id_(engine_id) {}

  /// Applies what has arrived for this engine; `say` hears of each.
  void apply_all(SimulatedEngine& simulation, const std::function<void(const std::string&)>& say);

 private:
  wire::Reader<SimCommand> reader_;
  std::uint32_t engine_id_;
};

}  // namespace ehm::engine
