// SPDX-License-Identifier: Apache-2.0
#pragma once
// A recorded row as the message that it was.

#include "deploy/runtime/recording/layout.h"
#include "engine_health.h"

namespace ehm::engine_sim {

/// Channels that were not recorded are 0, as on the wire; `shift_ns` moves the time stamp.
EngineSensors message_of(const recording::Row& row, const recording::Channels& channels, std::int64_t shift_ns);

/// Names and units of an engine's channels; trims and noise are not recorded.
EngineDescription description_of(std::uint32_t engine_id, std::uint32_t source_id, const recording::FileInfo& info);

}  // namespace ehm::engine_sim
