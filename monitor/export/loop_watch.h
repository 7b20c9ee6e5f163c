// SPDX-License-Identifier: Apache-2.0
#pragma once
// How long ago a loop turned last, for who looks from outside at least every 50 ms or so. Real-time safe for the loop:
// it only counts. One thread looks.

#include <cstdint>

#include "deploy/runtime/service/watchdog.h"

namespace ehm::monitor {

class LoopWatch {
 public:
  LoopWatch(const service::TurnCounter& loop, std::int64_t now_ns)
      : loop_(loop), turns_(loop.turns()), changed_ns_(now_ns) {}

  void look(std::int64_t now_ns) noexcept {
    if (const std::uint64_t turns = loop_.turns(); turns != turns_) {
      turns_ = turns;
      changed_ns_ = now_ns;
    }
  }
  double age_s(std::int64_t now_ns) const noexcept { return 1e-9 * static_cast<double>(now_ns - changed_ns_); }
  std::uint64_t turns() const noexcept { return turns_; }

 private:
  const service::TurnCounter& loop_;
  std::uint64_t turns_;
  std::int64_t changed_ns_;
};

/// Longest age of a loop that lives: the cycle turns 60 times a second and at each sample, the reporter each 5 ms.
inline constexpr double longest_turn_s = 0.25;

/// The ages of the loops that must turn for the service to be of use, and of what it shows.
struct Ages {
  double cycle_s = 0.0, reporter_s = 0.0;
  std::int64_t now_ns = 0;       ///< monotonic
  double status_limit_s = 10.0;  ///< an engine's status is due before
};

}  // namespace ehm::monitor
