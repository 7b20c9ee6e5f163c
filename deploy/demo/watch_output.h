// SPDX-License-Identifier: Apache-2.0
#pragma once
// How ehm_watch shows what it heard: a table that refreshes in place, plain lines, a summary, or one JSON object; and
// what it makes of a run. `columns`: of the terminal.

#include <cstdint>
#include <string>

#include "deploy/demo/watch_data.h"

namespace ehm::demo {

/// Full table for a terminal; begins with the cursor movement that overwrites the last one.
std::string table(const WatchData& data, int columns);
/// One line for a log, wrapped.
std::string line(const WatchData& data, int columns);
/// Final table with deviations in sigma where there is truth, counts and events.
std::string summary(const WatchData& data, int columns);
/// The summary for scripts.
std::string json(const WatchData& data);

/// Why the run does not pass; empty when it passes. Losses, withheld samples, a monitor that said ERROR, estimates that
/// are no numbers, and with truth those outside `sigmas` of their published sigma.
std::string verdict(const WatchData& data, double sigmas);
/// Is there truth beside the last estimate, so that its error could be judged?
bool accuracy_judged(const WatchData& data);
/// What is to be said once of truth that does not count; empty while there is none, or so little that its source may
/// still be to be heard of.
std::string ignored_truth(const WatchData& data, std::uint32_t engine_id);

}  // namespace ehm::demo
