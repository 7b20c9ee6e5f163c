#pragma once
// Does the source keep the design's sample time? Over blocks of 64 samples the mean of dt / steps, by the source's
// clock, must lie within 10 % of it; a single late sample or step of the source's clock does not matter (dt counts as
// at most three sample times a step), a source of another rate does: every time constant of the filter would be wrong.
// Outside, estimates are withheld. Real-time safe: yes.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "monitor/checks/sample_check.h"
#include "monitor/judge/events.h"

namespace ehm::monitor {

class SampleTimeWatch {
 public:
  explicit SampleTimeWatch(double sample_time_s) : sample_time_s_(sample_time_s) {}

  /// True while the sample time is right.
  bool judge(const SampleDecision& decision, EventList& events) noexcept {
    if (decision.verdict != SampleVerdict::accepted) {
      sum_s_ = 0.0;
      steps_ = 0;
      return !condition_.raised();
    }
    sum_s_ += std::min(decision.dt_s, most_periods * sample_time_s_ * decision.steps);
    steps_ += decision.steps;
    if (steps_ >= block) {
      const double mean_s = sum_s_ / static_cast<double>(steps_);
      condition_.set(std::abs(mean_s / sample_time_s_ - 1.0) > tolerance,
                     {wire::EventKind::sample_time, 0, false, mean_s, sample_time_s_, 0}, events);
      sum_s_ = 0.0;
      steps_ = 0;
    }
    return !condition_.raised();
  }

 private:
  static constexpr std::int64_t block = 64;
  static constexpr double tolerance = 0.1, most_periods = 3.0;
  double sample_time_s_, sum_s_ = 0.0;
  std::int64_t steps_ = 0;
  Condition condition_;
};

}  // namespace ehm::monitor
