// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where an engine's EGT margin goes: a line through the flights since the latest maintenance, least squares with equal
// weights, since what errs from flight to flight is much the same.
//   margin(n) = a + b (n - n_last)       b, and its standard deviation from the scatter about the line
//   flights left until the limit: (a - limit)/-b; their 95 % range from b +- 1.96 sigma_b
// Errors: none.

#include <cstdint>
#include <optional>
#include <vector>

#include "monitor/history/flight_entry.h"

namespace ehm::monitor {

struct MarginTrend {
  std::size_t flights = 0;               ///< that the line goes through
  double margin_k = 0.0, sigma_k = 0.0;  ///< of the latest flight, as that was summed up
  double a_k = 0.0;                      ///< on the line, at the latest flight
  double per_flight_k = 0.0, per_flight_sigma_k = 0.0;
  /// Flights until the limit; least and most with 95 %. Nothing where the margin does not fall, or may not.
  std::optional<double> left, left_least, left_most;
};

/// Nothing with fewer than three flights with margins since the latest maintenance.
std::optional<MarginTrend> margin_trend(const std::vector<HistoryEntry>& entries, double limit_k);

/// By how much the margin of the flight after a maintenance is above that before; of the latest of its kind.
struct Recovery {
  Maintenance::Kind kind;
  std::uint32_t after_flight = 0;
  double gained_k = 0.0;
};
std::vector<Recovery> recoveries(const std::vector<HistoryEntry>& entries);

}  // namespace ehm::monitor
