// SPDX-License-Identifier: Apache-2.0
#pragma once
// Does the source keep the design's sample time? Over blocks of 64 sample times the mean of dt / steps, by the source's
// clock, must lie within 10 % of it; a source of another rate makes every time constant of the filter wrong, and its
// estimates are withheld. Stamps that came late in a burst leave the mean alone, and one step of the source's clock
// spoils one block only: two blocks in a row must be outside, on the same side.
//
// Stamps that are not usable are told from another rate by their moves: a block goes on until the stamp has moved 20
// times, so that the ticks of a coarse clock count as 5 % at most. A clock that has not moved so often in 8192 sample
// times measures nothing: whatever was said of the sample time is taken back. Real-time safe: yes.

#include <cstdint>

#include "monitor/checks/sample_check.h"
#include "monitor/data/events.h"

namespace ehm::monitor {

class SampleTimeWatch {
 public:
  static constexpr double tolerance = 0.1;  ///< of the design's sample time
  /// Detail of the event that ends the condition because the stamps measure no sample time any more.
  static constexpr std::uint32_t not_measured = 1;

  explicit SampleTimeWatch(double sample_time_s) : sample_time_s_(sample_time_s) {}

  /// True while the sample time is right.
  bool check(const SampleDecision& decision, EventList& events) noexcept {
    if (decision.verdict != SampleVerdict::accepted) {
      begin_block();
      return !condition_.raised();
    }
    sum_s_ += decision.dt_s;
    steps_ += decision.steps;
    moves_ += decision.dt_s != 0.0;
    if (steps_ >= block && moves_ >= least_moves) {
      const double mean_s = sum_s_ / static_cast<double>(steps_);
      const double excess = mean_s / sample_time_s_ - 1.0;
      const int side = excess > tolerance ? 1 : excess < -tolerance ? -1 : 0;
      condition_.set(side != 0 && (condition_.raised() || side == last_side_),
                     {.kind = idl::EventKind::sample_time, .value = mean_s, .threshold = sample_time_s_}, events);
      last_side_ = side;
      begin_block();
    } else if (steps_ >= too_long) {
      condition_.set(false, {.kind = idl::EventKind::sample_time, .threshold = sample_time_s_, .detail = not_measured},
                     events);
      last_side_ = 0;
      begin_block();
    }
    return !condition_.raised();
  }
  void end_with_design(EventList& events) noexcept {
    condition_.end_with_design(idl::EventKind::sample_time, 0, events);
  }

 private:
  static constexpr std::int64_t block = 64, least_moves = 20, too_long = 8192;
  void begin_block() noexcept {
    sum_s_ = 0.0;
    steps_ = 0;
    moves_ = 0;
  }

  double sample_time_s_, sum_s_ = 0.0;
  std::int64_t steps_ = 0, moves_ = 0;
  int last_side_ = 0;  ///< of the block before: -1 too fast, 1 too slow
  Condition condition_;
};

}  // namespace ehm::monitor
