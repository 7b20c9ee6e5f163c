// SPDX-License-Identifier: Apache-2.0
#pragma once
// An engine's history for people: the summary of a flight, the table of all, the EGT margin over them, and what is due.

#include <cstdint>
#include <string>

#include "monitor/history/flight_entry.h"
#include "monitor/history/history_folder.h"

namespace ehm::monitor {

/// "flight 3: 6472 s, estimates in 100.0 %, EGT margin 41.2 +- 1.8 K, ..."
std::string flight_line(const Flight& flight);
/// With what the flight has found of every health parameter.
std::string flight_text(const Flight& flight);
/// Table, plot and outlook. `limit_k`: the EGT margin at which the engine is to be taken off the wing.
std::string history_text(std::uint32_t engine_id, const FlightHistory& history, double limit_k);

}  // namespace ehm::monitor
