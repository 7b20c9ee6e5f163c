// SPDX-License-Identifier: Apache-2.0
#pragma once
// One SimCommand carried out between two samples: what its field may be, whether the engine survives it, and what
// became of it as the one text that is both logged and answered.

#include "engine_health.h"
#include "engine_sim/simulated_engine.h"

namespace ehm::engine_sim {

/// Carries the command out at the engine's present time. Its answer: engine_id, role, request and kind of the
/// command, accepted, and what was done or which field, value and allowed range refuse it, with nothing changed.
CommandReply apply(const SimCommand& command, SimulatedEngine& engine);

}  // namespace ehm::engine_sim
