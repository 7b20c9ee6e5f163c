// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the monitor has published, as Prometheus metrics: prefix ehm_, base units (seconds, hertz, bytes), counters end
// in _total. Labels: engine (engine_id) and source (source_id of this monitor), and kind, channel, flag or percentile
// where a metric has several. deploy/docs/observability.md lists them all.

#include <string>

#include "monitor/export/loop_watch.h"
#include "monitor/export/status_board.h"

namespace ehm::monitor {

/// What one scrape shows.
struct ServiceView {
  FleetView fleet;
  std::uint32_t source_id = 0;
  std::uint64_t cycle_turns = 0;
  Ages ages;
  std::int64_t certificate_expires_s = 0;  ///< since 1970; 0 without security
};

/// The text exposition format, version 0.0.4, of the fleet, the service and the process.
std::string metrics_text(const ServiceView& view);

}  // namespace ehm::monitor
