// SPDX-License-Identifier: Apache-2.0
#pragma once
// What MonitorStatus says of one engine, from what its slot has counted. Real-time safe: yes.

#include "engine_health.h"
#include "idl/wire_values.h"
#include "monitor/shared/engine_slot.h"

namespace ehm::monitor {

/// STALE without input, ERROR without estimates, WARN with a restriction or with losses since the last status.
idl::StatusLevel level_of(const EngineSlot& slot) noexcept;

/// Every field that the slot knows; who publishes adds source, time and what is counted for the whole service.
/// `now_ns` and `start_ns` (of the service) are monotonic.
MonitorStatus make_status(const EngineSlot& slot, idl::StatusLevel level, std::int64_t now_ns, std::int64_t start_ns);

}  // namespace ehm::monitor
