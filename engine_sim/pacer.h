// SPDX-License-Identifier: Apache-2.0
#pragma once
// Periodic wake-ups on absolute deadlines of the monotonic clock, so that a late cycle never shifts the next one.
//
// A wake-up later than one whole period is a slip: it is counted, and the missed deadlines are run down back to back.

#include <time.h>

#include <cerrno>
#include <cstdint>

namespace ehm::engine_sim {

class Pacer {
 public:
  explicit Pacer(double period_s) : period_ns_(static_cast<std::int64_t>(period_s * 1e9)), next_ns_(now_ns()) {}

  /// Sleeps until the next deadline. False when a signal interrupted the sleep.
  bool wait() {
    next_ns_ += period_ns_;
    const std::int64_t late_ns = now_ns() - next_ns_;
    if (late_ns > period_ns_) ++slips_;
    if (late_ns > worst_ns_) worst_ns_ = late_ns;
    const timespec deadline{next_ns_ / 1'000'000'000, next_ns_ % 1'000'000'000};
    return clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) != EINTR;
  }

  /// Forgets the deadlines that were missed.
  void restart() { next_ns_ = now_ns(); }

  std::uint64_t slips() const { return slips_; }
  /// Longest lateness when a wait began, ns; how near the loop came to a slip.
  std::int64_t worst_ns() const { return worst_ns_; }

 private:
  static std::int64_t now_ns() {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * std::int64_t{1'000'000'000} + t.tv_nsec;
  }

  std::int64_t period_ns_, next_ns_;
  std::int64_t worst_ns_ = 0;
  std::uint64_t slips_ = 0;
};

}  // namespace ehm::engine_sim
