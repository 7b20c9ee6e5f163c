#pragma once
// One monitored engine: its cycle, its latencies, when it was last heard of.

#include <cstdint>
#include <memory>

#include "monitor/monitor_cycle.h"
#include "monitor/realtime/latency_histogram.h"

namespace ehm::monitor {

struct EngineSlot {
  EngineSlot(std::shared_ptr<const design::Design> design, const CycleOptions& options,
             std::shared_ptr<const FaultTables> faults)
      : cycle(std::move(design), options, std::move(faults)) {}

  std::uint32_t engine_id = 0;  ///< 0: not assigned yet
  MonitorCycle cycle;
  LatencyHistogram latency;
  Sample sample;                      ///< the latest
  std::int64_t received_ns = 0;       ///< monotonic, of the latest sample
  std::uint64_t deadline_misses = 0;  ///< estimates later than one sample time after their sample
  std::uint64_t writes_refused = 0;   ///< by the middleware, on any estimate topic
  std::int64_t status_ns = 0;         ///< monotonic, of the latest status
  std::uint64_t status_received = 0;  ///< samples received up to that status
  std::uint32_t status_level = 0;
  CycleCounters status_counters;  ///< at that status, to tell what is new
};

}  // namespace ehm::monitor
