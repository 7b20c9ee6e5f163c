// SPDX-License-Identifier: Apache-2.0
#pragma once
// Everything that configures the monitor, as plain values; service/config.h gives each its key, range and description.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "monitor/data/options.h"
#include "monitor/realtime/rt_setup.h"

namespace ehm::monitor {

/// Which design and estimators fly for which engines; without [[engine]] tables every engine flies monitor.design.
struct EngineAssignment {
  std::vector<std::int64_t> ids;
  std::string design;
  std::optional<std::string> published = {}, shadow = {};  ///< without: those of [estimator]
};

/// Everything that the cycles see and say, in a file (deploy/docs/recording.md).
struct RecordOptions {
  std::string file;  ///< empty: nothing is recorded
  std::int64_t max_mb = 1000;
  std::int64_t max_files = 10;
};

/// A recording or a CSV file through the cycles, without DDS.
struct OfflineOptions {
  std::string file;  ///< empty: the service runs
  std::string out;
  std::string column_map;  ///< of a CSV file
  bool all_estimators = false;
};

/// What is kept of each engine from flight to flight.
struct HistoryOptions {
  std::string directory;           ///< empty: nothing is kept
  double wear_percent = 0.05;      ///< standard deviation by which a health parameter may wear from flight to flight
  std::int64_t first_flights = 3;  ///< whose outcome wear is counted from
};

struct MonitorConfig {
  std::string design;
  std::vector<EngineAssignment> engines;
  std::int64_t source_id = 101;
  std::int64_t max_engines = 16;
  double status_period_s = 1.0;
  double forget_engine_s = 600.0;  ///< 0: never
  std::string clock = "monotonic";
  CycleOptions cycle;
  RealtimeOptions realtime;
  RecordOptions record;
  OfflineOptions offline;
  HistoryOptions history;

  std::string checkpoint_directory;  ///< empty: no checkpoints
  double checkpoint_period_s = 5.0;
  double checkpoint_max_age_s = 300.0;

  std::int64_t domain = 0;
  std::string partition, profiles_file, profile = "ehm_participant", security;
  bool security_required = false;
  std::string ownership = "shared";
  std::int64_t ownership_strength = 1;
  double input_deadline_s = 0.0, input_lease_s = 0.0;
  std::string log_level = "info";
  std::string metrics_listen = "127.0.0.1:9477";  ///< HOST:PORT; empty: none
};

}  // namespace ehm::monitor
