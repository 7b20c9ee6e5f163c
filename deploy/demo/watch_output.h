#pragma once
// How ehm_watch shows what it heard: a table that refreshes in place, plain lines, a summary, or one JSON object.

#include <string>

#include "deploy/demo/watch_data.h"

namespace ehm::demo {

/// Full table for a terminal; begins with the cursor movement that overwrites the last one.
std::string table(const WatchData& data);
/// One line for a log.
std::string line(const WatchData& data);
/// Final table with deviations in sigma, counts and events.
std::string summary(const WatchData& data);
/// The summary for scripts.
std::string json(const WatchData& data);

/// Why the run does not pass: losses, estimates outside `sigmas` of their published sigma. Empty when it passes.
std::string verdict(const WatchData& data, double sigmas);

}  // namespace ehm::demo
