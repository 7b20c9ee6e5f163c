// SPDX-License-Identifier: Apache-2.0
#pragma once
// Resets are obeyed, but not as fast as anybody sends them: a filter that is reset all the time never converges.
//
//   obeyed    no other reset of this engine within 2 s
//   refused   otherwise; the condition command_flood is raised, and ends 10 s after the last refusal
// Real-time safe: yes.

#include <cstdint>

#include "monitor/data/events.h"

namespace ehm::monitor {

class ResetThrottle {
 public:
  static constexpr double period_s = 2.0;

  /// A reset is asked for at `now_ns`, monotonic; true if it is to be obeyed.
  bool ask(std::int64_t now_ns, EventList& events) noexcept {
    if (obeyed_ns_ == never || now_ns - obeyed_ns_ >= static_cast<std::int64_t>(1e9 * period_s)) {
      obeyed_ns_ = now_ns;
      return true;
    }
    ++refused_;
    refused_ns_ = now_ns;
    flood_.set(true, event(), events);
    return false;
  }
  void look(std::int64_t now_ns, EventList& events) noexcept {
    if (!raised() || now_ns - refused_ns_ < quiet_ns) return;
    flood_.set(false, event(), events);
    refused_ = 0;
  }
  bool raised() const noexcept { return flood_.raised(); }
  std::uint64_t refused() const noexcept { return refused_; }

 private:
  Event event() const noexcept {
    return {.kind = idl::EventKind::command_flood, .value = static_cast<double>(refused_), .threshold = period_s};
  }
  static constexpr std::int64_t never = INT64_MIN, quiet_ns = 10'000'000'000;
  std::int64_t obeyed_ns_ = never, refused_ns_ = 0;
  std::uint64_t refused_ = 0;
  Condition flood_;
};

}  // namespace ehm::monitor
