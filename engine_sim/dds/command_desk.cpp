// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/dds/command_desk.h"

#include <spdlog/spdlog.h>

#include "engine_sim/dds/apply_command.h"

namespace ehm::engine_sim {

void CommandDesk::serve(SimulatedEngine& engine) {
  SimCommand command;
  while (commands_.take(command)) {
    if (command.engine_id() != engine_id_) continue;
    CommandReply reply = apply(command, engine);
    spdlog::info("command {}: {}", reply.accepted() != 0 ? "done" : "refused", reply.message().c_str());
    if (command.request() == 0) continue;
    reply.source_id(source_id_);
    if (!replies_.write(reply)) spdlog::warn("the answer to request {} could not be sent", command.request());
  }
}

}  // namespace ehm::engine_sim
