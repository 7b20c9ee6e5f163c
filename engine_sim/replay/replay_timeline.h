// SPDX-License-Identifier: Apache-2.0
#pragma once
// When each row of a recording is due, counted from the first one.
//
// Between two samples of one engine passes the time of its source's clock, so that a flight that was recorded at rate
// max replays at its own pace. Where that clock stepped back or jumped by more than two seconds, the time between the
// receptions counts instead; so it does while the clock stands still or is not set, until it moves on: what it then
// shows counts from where it stopped, so that the ticks of a coarse clock lengthen nothing. Rows stay in their order.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>

#include "deploy/runtime/recording/row.h"

namespace ehm::engine_sim {

class ReplayTimeline {
 public:
  /// Nanoseconds after the first row; never less than for the row before.
  std::int64_t due_ns(const recording::Row& row) {
    const auto [entry, is_new] = engines_.try_emplace(row.a.unit);
    Last& last = entry->second;
    if (is_new) {
      last.due_ns = latest_.due_ns + std::max<std::int64_t>(0, row.a.received_ns - latest_.received_ns);
      if (engines_.size() == 1) last.due_ns = 0;
    } else {
      const std::int64_t source_ns = row.a.source_time_ns - last.source_time_ns;
      const std::int64_t received_ns = std::max<std::int64_t>(0, row.a.received_ns - last.received_ns);
      if (source_ns == 0 || row.a.source_time_ns == 0) return due(last, last.due_ns + received_ns, row);
      last.due_ns += source_ns > 0 && source_ns <= longest_step_ns ? source_ns : received_ns;
      // It stood, and went on from where it stood: nothing is caught up.
      if (last.latest_due_ns - last.due_ns > std::abs(source_ns)) last.due_ns = last.latest_due_ns;
    }
    last.source_time_ns = row.a.source_time_ns;
    last.received_ns = row.a.received_ns;
    return due(last, last.due_ns, row);
  }

 private:
  struct Last {  ///< of an engine's stamps, the latest that moved
    std::int64_t source_time_ns = 0, received_ns = 0, due_ns = 0;
    std::int64_t latest_due_ns = 0;  ///< of its latest row
  };
  std::int64_t due(Last& engine, std::int64_t due_ns, const recording::Row& row) {
    engine.latest_due_ns = due_ns;
    latest_.due_ns = std::max(latest_.due_ns, due_ns);
    latest_.received_ns = row.a.received_ns;
    return latest_.due_ns;
  }

  static constexpr std::int64_t longest_step_ns = 2'000'000'000;
  std::map<std::int64_t, Last> engines_;
  Last latest_;
};

}  // namespace ehm::engine_sim
