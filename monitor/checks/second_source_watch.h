// SPDX-License-Identifier: Apache-2.0
#pragma once
// Somebody else sends samples of the engine that a source already serves: said once, and ended once nobody else has for
// 3 s of the source that is followed, by its sample times, or when that one has fallen silent. Real-time safe: yes.

#include <cmath>

#include "monitor/data/events.h"
#include "monitor/data/sample.h"

namespace ehm::monitor {

class SecondSourceWatch {
 public:
  explicit SecondSourceWatch(double sample_time_s) : enough_(std::lround(std::ceil(quiet_s / sample_time_s - 0.01))) {}

  /// A sample that is not listened to, because `followed_id` is the source's.
  void foreign(const Sample& sample, std::uint32_t followed_id, EventList& events) noexcept {
    quiet_ = 0;
    condition_.set(true,
                   {.kind = idl::EventKind::second_source,
                    .raised = true,
                    .value = static_cast<double>(sample.source_id),
                    .threshold = static_cast<double>(followed_id)},
                   events);
  }
  /// A sample of the source that is followed, `steps` sample times after the one before.
  void followed(int steps, EventList& events) noexcept {
    if (condition_.raised() && (quiet_ += steps) >= enough_) end(events);
  }
  /// Nobody is followed any more; whoever sends next will be.
  void end(EventList& events) noexcept { condition_.set(false, {.kind = idl::EventKind::second_source}, events); }

 private:
  static constexpr double quiet_s = 3.0;
  long enough_;     ///< sample times
  long quiet_ = 0;  ///< sample times since the other one's last sample
  Condition condition_;
};

}  // namespace ehm::monitor
