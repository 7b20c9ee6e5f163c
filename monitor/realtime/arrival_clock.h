// SPDX-License-Identifier: Apache-2.0
#pragma once
// When a sample arrived, on the monotonic clock. The middleware stamps receptions with the wall clock, which an
// operator or NTP may step; a latency must not notice.
//
// Real-time safe: yes. Errors: none.

#include <cstdint>
#include <cstdlib>

#include "monitor/realtime/clock.h"

namespace ehm::monitor {

class ArrivalClock {
 public:
  /// Call when the thread wakes up for samples that have come since the last call.
  void wake_up() noexcept { wake_up(monotonic_ns(), wall_clock_ns()); }
  void wake_up(std::int64_t now_ns, std::int64_t wall_ns) noexcept {
    const std::int64_t ahead_ns = wall_ns - now_ns;
    stepped_ = std::llabs(ahead_ns - ahead_ns_) > step_ns;
    ahead_ns_ = ahead_ns;
    woken_ns_ = now_ns;
  }
  /// Of a sample received since the last wake-up but one. Where the wall clock was stepped in the meantime nobody knows
  /// whether before or after the reception: it then counts as received at the wake-up.
  std::int64_t monotonic_of(std::int64_t reception_wall_ns) const noexcept {
    return stepped_ ? woken_ns_ : reception_wall_ns - ahead_ns_;
  }

 private:
  static constexpr std::int64_t step_ns = 1'000'000;  // NTP slews far less between two wake-ups

  std::int64_t ahead_ns_ = 0;  ///< wall clock minus monotonic clock
  std::int64_t woken_ns_ = 0;
  bool stepped_ = true;
};

}  // namespace ehm::monitor
