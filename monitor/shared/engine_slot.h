// SPDX-License-Identifier: Apache-2.0
#pragma once
// One monitored engine: its cycle, its latencies, when it was last heard of.

#include <cstdint>
#include <utility>
#include <vector>

#include "monitor/cycle/monitor_cycle.h"
#include "monitor/flight/flight_log.h"
#include "monitor/realtime/clock.h"
#include "monitor/realtime/latency_histogram.h"
#include "monitor/shared/budget_watch.h"
#include "monitor/shared/reset_throttle.h"

namespace ehm::monitor {

/// What is counted and remembered of an engine beside its cycle; another design goes on with it.
struct EngineTally {
  LatencyHistogram latency;
  Sample sample;                              ///< the latest, in order or not
  std::uint64_t participant = 0;              ///< number of the participant that the latest sample in order is from
  std::uint64_t last_sequence = 0;            ///< of the latest sample in order
  std::int64_t received_ns = 0;               ///< monotonic, of the latest sample in order
  std::int64_t heard_ns = 0;                  ///< the same, or of one whose sequence number stands still
  std::int64_t malformed_ns = 0;              ///< monotonic, when malformed samples were last spoken of
  std::uint64_t deadline_misses = 0;          ///< estimates later than one sample time after their sample
  std::uint64_t writes_refused = 0;           ///< by the middleware, on any estimate topic
  std::int64_t status_ns = 0;                 ///< monotonic, of the latest status
  std::int64_t rate_ns = 0;                   ///< monotonic, from when on the rate is measured
  std::uint64_t rate_received = 0;            ///< samples received up to then
  std::uint64_t recorded_loss_after = ~0ull;  ///< samples received when the recording's latest loss of input was noted
  std::uint64_t status_records_lost = 0;      ///< rows lost up to the latest status
  Condition losing_records;                   ///< between the latest two of them
  std::uint32_t status_level = 0;
  CycleCounters status_counters;  ///< at that status, to tell what is new
  ResetThrottle resets;
  FlightLog flights;
  bool landing_due = false;  ///< the latest flight has not been handed over yet
};

struct EngineSlot : EngineTally {
  EngineSlot(const PreparedDesign& design, const CycleOptions& options, std::vector<int> shadows = {})
      : cycle(design, options), fan(fan_speed_of(cycle.design().model)), shadow_place(std::move(shadows)) {
    cycle.measure(monotonic_ns);
  }

  /// Everything but the cycle: another design goes on for the same engine. Real-time safe: yes.
  void inherit(const EngineSlot& before) noexcept {
    cycle.adopt(before.cycle.counters());
    static_cast<EngineTally&>(*this) = before;
  }
  /// As it was at start; `pristine` has the same design and options, and so a copy allocates nothing. Real-time safe:
  /// yes.
  void vacate(const MonitorCycle& pristine) noexcept {
    cycle = pristine;
    static_cast<EngineTally&>(*this) = {};
    engine_id = 0;
    budget = {};
    checkpoint_ns = 0;
    checkpoint_processed = 0;
    released = false;
  }

  std::uint32_t engine_id = 0;  ///< 0: nobody's yet
  std::size_t number = 0;       ///< its place in the table
  MonitorCycle cycle;
  FanSpeed fan;                   ///< of the cycle's design
  std::vector<int> shadow_place;  ///< of its shadows among those of all engines (engine_estimators.h)
  BudgetWatch budget;
  std::int64_t checkpoint_ns = 0;          ///< monotonic, of the latest checkpoint
  std::uint64_t checkpoint_processed = 0;  ///< samples processed up to that checkpoint
  bool released = false;                   ///< its estimates are no longer written: the monitor stops
};

}  // namespace ehm::monitor
