// SPDX-License-Identifier: Apache-2.0
#pragma once
// The two clocks of a service: monotonic for ages and latencies, wall clock for stamps on the wire.

#include <time.h>

#include <cstdint>

namespace ehm::monitor {

inline std::int64_t clock_ns(clockid_t clock) noexcept {
  timespec t{};
  clock_gettime(clock, &t);
  return t.tv_sec * std::int64_t{1'000'000'000} + t.tv_nsec;
}
inline std::int64_t monotonic_ns() noexcept {
  return clock_ns(CLOCK_MONOTONIC);
}
inline std::int64_t wall_clock_ns() noexcept {
  return clock_ns(CLOCK_REALTIME);
}

}  // namespace ehm::monitor
