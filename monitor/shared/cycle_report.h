// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the cycle thread hands to the reporter thread, so that logs, events and status cost the cycle only a copy.

#include <cstdint>

#include "engine_health.h"
#include "monitor/checks/source_fit.h"
#include "monitor/data/events.h"
#include "monitor/design/design.h"
#include "monitor/realtime/spsc_queue.h"
#include "monitor/shared/estimate_snapshot.h"

namespace ehm::monitor {

/// What a sample that cannot be used says of itself.
struct Malformed {
  std::uint32_t source_id = 0, schema = 0, sensor_count = 0, actuator_count = 0;
  std::uint64_t so_far = 0;  ///< of this engine
};

/// A channel, or the engine, as its source describes it, where that is not as the design's.
struct SourceChannel {
  std::uint32_t source_id = 0;
  /// In place of a channel: the engine's type, said.name, is not the design's.
  static constexpr std::uint32_t engine_type = EHM_MAX_SENSORS + EHM_MAX_ACTUATORS;
  std::uint32_t channel = 0;  ///< sensor, EHM_MAX_SENSORS + actuator, or engine_type
  Misfit misfit = Misfit::none;
  bool raised = false;
  std::uint32_t converted = 0;  ///< so many channels of the source are converted, this one first; then no event
  DescribedChannel said;
};

/// What became of a MonitorCommand that asks for an answer.
struct OrderOutcome {
  enum class Kind { done, other_schema, unknown_kind, not_served, too_soon, not_flying, no_answer };
  Kind kind = Kind::done;
  std::uint32_t request = 0, order = 0;    ///< of the command: its request number, its MonitorCommandKind
  std::uint32_t engines = 0, refused = 0;  ///< that it is for; of those: not obeyed
};

struct CycleReport {
  enum class Kind { event, status, new_engine, engine_left, unknown_engine, malformed, source_channel, reply };
  Kind kind = Kind::event;
  std::uint32_t engine_id = 0;
  const design::Design* design = nullptr;  ///< lives as long as the engine table
  Event event = {};                        ///< Kind::event
  std::uint64_t sequence = 0;
  std::int64_t source_time_ns = 0;
  MonitorStatus status = {};          ///< Kind::status
  EstimateSnapshot estimates = {};    ///< Kind::status
  Malformed malformed = {};           ///< Kind::malformed
  SourceChannel source_channel = {};  ///< Kind::source_channel
  OrderOutcome outcome = {};          ///< Kind::reply
};

/// Room for several reports of each of a thousand engines between two turns of the reporter.
using CycleReportQueue = SpscQueue<CycleReport, 8192>;

}  // namespace ehm::monitor
