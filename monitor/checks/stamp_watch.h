// SPDX-License-Identifier: Apache-2.0
#pragma once
// Do the source's stamps measure time? One that is not set (0), repeats the one before, or steps back says no: said
// once, with the reason of the first, and ended after 10 s of good stamps. Each return doubles these 10 s, up to an
// hour, so that a clock that repeats a stamp now and then does not fill the log.
//
// Steps come from the sequence number in any case, so estimates go on; only the sample time cannot be checked while
// the stamps stand still (sample_time_watch.h). Real-time safe: yes.

#include <algorithm>

#include "monitor/checks/sample_check.h"
#include "monitor/data/events.h"

namespace ehm::monitor {

class StampWatch {
 public:
  explicit StampWatch(double sample_time_s) : sample_time_s_(sample_time_s) {}

  void check(const SampleDecision& decision, EventList& events) noexcept {
    if (decision.verdict != SampleVerdict::accepted) return;
    if (decision.stamp != StampState::good) {
      if (!condition_.raised() && told_before_) calm_s_ = std::min(longest_calm_s, 2.0 * calm_s_);
      told_before_ = true;
      good_s_ = 0.0;
      condition_.set(true,
                     {.kind = idl::EventKind::source_stamps,
                      .raised = true,
                      .value = decision.dt_s,
                      .detail = static_cast<std::uint32_t>(decision.stamp)},
                     events);
    } else if (condition_.raised()) {
      good_s_ += sample_time_s_ * decision.steps;
      if (good_s_ >= calm_s_) end(events);
    }
  }
  bool raised() const noexcept { return condition_.raised(); }
  void end(EventList& events) noexcept { condition_.set(false, {.kind = idl::EventKind::source_stamps}, events); }

 private:
  static constexpr double longest_calm_s = 3600.0;
  double sample_time_s_;
  double calm_s_ = 10.0, good_s_ = 0.0;
  bool told_before_ = false;
  Condition condition_;
};

}  // namespace ehm::monitor
