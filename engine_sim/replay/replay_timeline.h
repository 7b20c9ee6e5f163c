#pragma once
// When each row of a recording is due, counted from the first one.
//
// Between two samples of one engine passes the time of its source's clock, so that a flight that was recorded at rate
// max replays at its own pace. Where that clock stood still, stepped back or jumped by more than two seconds, the time
// between the receptions counts instead. Rows stay in their order.

#include <algorithm>
#include <cstdint>
#include <map>

#include "deploy/recording/row.h"

namespace ehm::engine {

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
      last.due_ns += source_ns > 0 && source_ns <= longest_step_ns ? source_ns : received_ns;
    }
    last.source_time_ns = row.a.source_time_ns;
    last.received_ns = row.a.received_ns;
    latest_.due_ns = std::max(latest_.due_ns, last.due_ns);
    latest_.received_ns = row.a.received_ns;
    return latest_.due_ns;
  }

 private:
  static constexpr std::int64_t longest_step_ns = 2'000'000'000;
  struct Last {
    std::int64_t source_time_ns = 0, received_ns = 0, due_ns = 0;
  };
  std::map<std::int64_t, Last> engines_;
  Last latest_;
};

}  // namespace ehm::engine
