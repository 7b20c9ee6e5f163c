// SPDX-License-Identifier: Apache-2.0
#pragma once
// What became of a MonitorCommand, as the answer on the wire.

#include <cstdint>

#include "monitor/shared/cycle_report.h"

namespace ehm::monitor {

/// `engine_id` as in the command, 0 for all; `source_id` is ours. May allocate.
CommandReply reply_to(std::uint32_t engine_id, const OrderOutcome& outcome, std::uint32_t source_id);

}  // namespace ehm::monitor
