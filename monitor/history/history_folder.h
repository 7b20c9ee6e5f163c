// SPDX-License-Identifier: Apache-2.0
#pragma once
// The folder with what is known of each engine from flight to flight: engine_ID_baseline.json, replaced as a whole, and
// engine_ID_flights.jsonl, to which each flight and each maintenance adds a line.
// @throws files::FileError (file, and the system's reason or what is wrong in it) from all but the paths.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "monitor/history/baseline.h"
#include "monitor/history/flight_entry.h"

namespace ehm::monitor {

std::string baseline_path(const std::string& folder, std::uint32_t engine_id);
std::string flights_path(const std::string& folder, std::uint32_t engine_id);

/// The engines that have one of the two there, ascending.
std::vector<std::uint32_t> engines_in(const std::string& folder);
/// Nothing where there is no such file.
std::optional<Baseline> read_baseline(const std::string& folder, std::uint32_t engine_id);
void write_baseline(const std::string& folder, const Baseline& baseline);

struct FlightHistory {
  std::vector<HistoryEntry> entries;      ///< in the order of the file
  std::string torn = {};                  ///< a last line that a power cut has left incomplete; empty: there is none
  std::vector<std::string> damaged = {};  ///< lines that cannot be read: each with file, line and what is wrong
  bool damaged_since_flight = false;  ///< one of them is behind the last flight: maintenance may have been noted in it
};
/// Nothing where there is no such file. @throws files::FileError for the first line that cannot be read.
FlightHistory read_history(const std::string& folder, std::uint32_t engine_id);
/// The same, but leaves such lines out.
FlightHistory read_what_can_be(const std::string& folder, std::uint32_t engine_id);
/// One line, as to_line() makes it, behind the others; it is on the disk when this returns. A torn last line is ended.
void add_to_history(const std::string& folder, std::uint32_t engine_id, const std::string& line);

}  // namespace ehm::monitor
