// SPDX-License-Identifier: Apache-2.0
#pragma once
// The memory layout of the stream types equals their serialised layout (XCDR1, little endian): Fast DDS then copies
// them in one piece. The generator decides this from the IDL and misjudges tail padding, so it is held here
// (deploy/docs/architecture.md, "Why it is as it is").

#include <cstddef>

#include "engine_health.h"

namespace ehm::idl {

namespace layout {
inline constexpr std::size_t word = 4, number = 8;
inline constexpr std::size_t sensors = EHM_MAX_SENSORS, health = EHM_MAX_HEALTH, auxiliary = EHM_MAX_AUXILIARY,
                             actuators = EHM_MAX_ACTUATORS, mismatch = EHM_MAX_MISMATCH;
}  // namespace layout

static_assert(sizeof(EngineSensors) == 6 * layout::word + (5 + layout::actuators + layout::sensors) * layout::number);
static_assert(sizeof(EngineHealth) == 8 * layout::word + (3 + 3 * layout::health + layout::sensors) * layout::number);
static_assert(sizeof(EngineAuxiliary) == 6 * layout::word + (3 + 3 * layout::auxiliary) * layout::number);
static_assert(sizeof(EngineResiduals) ==
              (6 + layout::sensors) * layout::word + (2 + 3 * layout::sensors) * layout::number);
static_assert(sizeof(EngineTruth) ==
              6 * layout::word + (2 + layout::health + layout::auxiliary + layout::mismatch) * layout::number);
static_assert(sizeof(MonitorStatus) == 8 * layout::word + 33 * layout::number);
static_assert(sizeof(SimCommand) == 6 * layout::word + 4 * layout::number);
static_assert(sizeof(MonitorCommand) == 4 * layout::word);

}  // namespace ehm::idl
