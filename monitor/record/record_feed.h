// SPDX-License-Identifier: Apache-2.0
#pragma once
// The cycle thread's side of the recorder: one row for each sample that its cycle saw, and one for whatever else acted
// on the cycle, in their order, through a bounded queue. What the queue refuses is counted, and the next row tells how
// many are missing before it. Real-time safe: yes, all but the constructor.

#include <algorithm>
#include <array>
#include <atomic>

#include "monitor/realtime/clock.h"
#include "monitor/realtime/spsc_queue.h"
#include "monitor/record/record_row.h"

namespace ehm::monitor {

struct Record {
  recording::Row row;
  std::array<char, 64> design_hash{};  ///< whose estimates these are; a copy, since a reload may free the design
};

/// Two seconds of a hundred engines at 15 ms.
using RecordQueue = SpscQueue<Record, 16384>;

class RecordFeed {
 public:
  /// After the slot's cycle has processed its sample.
  void sample(const EngineSlot& slot, bool accepted) noexcept {
    fill_row(slot, accepted, next_.row);
    push(slot);
    for (int i = 0; accepted && i < slot.cycle.shadows(); ++i) {
      fill_shadow(slot, i, next_.row);
      push(slot);
    }
  }
  /// After the slot's cycle was told that no sample has come for `age_ns`, and took that as a loss. Noted once between
  /// two samples, even if neither was in order: telling it again changes nothing.
  void input_lost(EngineSlot& slot, std::int64_t age_ns) noexcept {
    if (slot.recorded_loss_after == slot.cycle.counters().received) return;
    slot.recorded_loss_after = slot.cycle.counters().received;
    marker(slot, recording::RowKind::input_lost, age_ns);
  }
  void marker(const EngineSlot& slot, recording::RowKind kind, std::int64_t value = 0) noexcept {
    fill_marker(slot, kind, value, next_.row);
    push(slot);
  }

  /// Rows that are not in the recording, since the start.
  std::uint64_t lost() const noexcept { return queue_.overflow() + unwritten_.load(std::memory_order_relaxed); }
  /// For the recorder: rows that it took and could not write.
  void count_unwritten(std::uint64_t rows) noexcept { unwritten_.fetch_add(rows, std::memory_order_relaxed); }
  RecordQueue& queue() noexcept { return queue_; }

 private:
  void push(const EngineSlot& slot) noexcept {
    next_.row.a.received_ns = monotonic_ns();
    next_.row.a.lost_before = static_cast<std::int64_t>(queue_.overflow());
    const std::string& hash = slot.cycle.design().hash;
    std::copy_n(hash.begin(), std::min(hash.size(), next_.design_hash.size()), next_.design_hash.begin());
    queue_.push(next_);
  }

  Record next_;
  RecordQueue queue_;
  std::atomic<std::uint64_t> unwritten_{0};
};

}  // namespace ehm::monitor
