// SPDX-License-Identifier: Apache-2.0
#pragma once
// The log of a service: lines go to standard error from a thread of their own. Whoever reads them may stop (Ctrl-S, a
// collector that hangs): the service never waits for it. 8192 lines are kept for it, then the oldest make room and are
// counted.

#include <cstdint>
#include <string>

namespace ehm::service {

/// Call it once, before the first line.
void start_log(const std::string& name);

/// Lines that nobody could read in time, since the start.
std::uint64_t lost_log_lines();

}  // namespace ehm::service
