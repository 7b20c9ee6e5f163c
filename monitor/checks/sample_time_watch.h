#pragma once
// Does the source keep the design's sample time? Over blocks of 64 samples the mean of dt / steps, by the source's
// clock, must lie within 10 % of it; a source of another rate makes every time constant of the filter wrong, and its
// estimates are withheld. Stamps that came late in a burst leave the mean alone, and one step of the source's clock
// spoils one block only: two blocks in a row must be outside, on the same side. Real-time safe: yes.

#include <cstdint>

#include "monitor/checks/sample_check.h"
#include "monitor/judge/events.h"

namespace ehm::monitor {

class SampleTimeWatch {
 public:
  static constexpr double tolerance = 0.1;  ///< of the design's sample time

  explicit SampleTimeWatch(double sample_time_s) : sample_time_s_(sample_time_s) {}

  /// True while the sample time is right.
  bool judge(const SampleDecision& decision, EventList& events) noexcept {
    if (decision.verdict != SampleVerdict::accepted) {
      sum_s_ = 0.0;
      steps_ = 0;
      return !condition_.raised();
    }
    sum_s_ += decision.dt_s;
    steps_ += decision.steps;
    if (steps_ >= block) {
      const double mean_s = sum_s_ / static_cast<double>(steps_);
      const double excess = mean_s / sample_time_s_ - 1.0;
      const int side = excess > tolerance ? 1 : excess < -tolerance ? -1 : 0;
      condition_.set(side != 0 && (condition_.raised() || side == last_side_),
                     {wire::EventKind::sample_time, 0, false, mean_s, sample_time_s_, 0}, events);
      last_side_ = side;
      sum_s_ = 0.0;
      steps_ = 0;
    }
    return !condition_.raised();
  }

 private:
  static constexpr std::int64_t block = 64;
  double sample_time_s_, sum_s_ = 0.0;
  std::int64_t steps_ = 0;
  int last_side_ = 0;  ///< of the block before: -1 too fast, 1 too slow
  Condition condition_;
};

}  // namespace ehm::monitor
