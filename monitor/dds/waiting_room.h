// SPDX-License-Identifier: Apache-2.0
#pragma once
// Samples that wait for what their source says of its channels (source_descriptions.h), while those of all others go
// on: whoever is not known yet must not hold anybody up.
//
// In the order of their arrival; of one writer and engine none overtakes another. Who finds no room lets all that wait
// go first: nothing is dropped or overtaken, some are used before their source has spoken.
// Real-time safe: yes, after construction.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine_health.h"

namespace ehm::monitor {

/// A sample with what the middleware says of it.
struct Arrival {
  EngineSensors sample;
  std::uint64_t writer = 0, participant = 0;  ///< numbers of idl/dds/qos.h
  std::int64_t arrival_ns = 0;                ///< monotonic
};

class WaitingRoom {
 public:
  explicit WaitingRoom(std::size_t capacity) : capacity_(capacity) { waiting_.reserve(capacity); }

  bool empty() const noexcept { return waiting_.empty(); }
  bool full() const noexcept { return waiting_.size() == capacity_; }
  /// Does a sample of this writer and engine wait? Then those that follow have to.
  bool holds(std::uint32_t engine_id, std::uint64_t writer) const noexcept {
    return holds(engine_id, writer, waiting_.size());
  }
  /// There is room.
  void add(const Arrival& arrival) noexcept { waiting_.push_back(arrival); }
  /// Hands out, in order, everything for which `waits(arrival)` does not hold any more.
  template <class Waits, class Take>
  void release(Waits&& waits, Take&& take) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      const Arrival& next = waiting_[i];
      if (!holds(next.sample.engine_id(), next.writer, kept) && !waits(next))
        take(next);
      else if (kept++ != i)
        waiting_[kept - 1] = next;
    }
    waiting_.resize(kept);
  }

 private:
  /// Is one of that writer and engine among the first of them?
  bool holds(std::uint32_t engine_id, std::uint64_t writer, std::size_t first) const noexcept {
    return std::any_of(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(first),
                       [&](const Arrival& a) { return a.sample.engine_id() == engine_id && a.writer == writer; });
  }

  std::size_t capacity_;
  std::vector<Arrival> waiting_;
};

}  // namespace ehm::monitor
