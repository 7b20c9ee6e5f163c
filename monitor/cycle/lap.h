// SPDX-License-Identifier: Apache-2.0
#pragma once
// The time that a piece of the cycle takes, by a clock that its owner lends: the cycle itself knows none, and what it
// answers does not depend on it. Errors: none. Real-time safe: as the clock.

#include <cstdint>

namespace ehm::monitor {

/// Monotonic, nanoseconds; null: nothing is measured.
using Stopwatch = std::int64_t (*)() noexcept;

/// Adds its own lifetime to `spent_ns`.
class Lap {
 public:
  Lap(Stopwatch now_ns, std::int64_t& spent_ns) noexcept
      : now_ns_(now_ns), spent_ns_(spent_ns), begun_ns_(now_ns ? now_ns() : 0) {}
  ~Lap() {
    if (now_ns_) spent_ns_ += now_ns_() - begun_ns_;
  }
  Lap(const Lap&) = delete;
  Lap& operator=(const Lap&) = delete;

 private:
  Stopwatch now_ns_;
  std::int64_t& spent_ns_;
  std::int64_t begun_ns_;
};

}  // namespace ehm::monitor
