#pragma once
// May an excluded sensor come back? Its value must fit what the filter predicts without it.
//
// The prediction without the sensor is biased by what only that sensor saw, so a fault of ten noise sigmas could hide
// in it. But at the moment of exclusion the full filter still predicted the sensor well: that offset is kept,
//   offset = (C xhat)_full,i - (C xhat)_without,i,      nu_return = nu_i - offset,
// and its variance grows from the full filter's innovation variance to the biased one over an hour, the time in which
// wear may have moved. A health shift in between makes the offset worthless, and so does a filter that
// had not converged when the sensor left: the wide variance then holds at once.
// Real-time safe: yes.

#include <algorithm>

namespace ehm::monitor {

class ReturnGate {
 public:
  /// What a checkpoint keeps of it.
  struct Memory {
    double offset = 0.0, narrow_variance = 1.0, wide_variance = 1.0, age_s = 0.0;
  };
  Memory memory() const noexcept { return {offset_, narrow_, wide_, age_s_}; }
  void resume(const Memory& memory) noexcept {
    start(memory.offset, memory.narrow_variance, memory.wide_variance);
    age_s_ = std::min(memory_s, memory.age_s);
  }

  void start(double offset, double narrow_variance, double wide_variance) noexcept {
    offset_ = offset;
    narrow_ = narrow_variance;
    wide_ = std::max(wide_variance, narrow_variance);
    age_s_ = 0.0;
  }
  /// The offset is worthless: only the wide variance is left.
  void forget() noexcept { age_s_ = memory_s; }
  void step(double dt_s) noexcept { age_s_ = std::min(memory_s, age_s_ + dt_s); }

  /// nu_return^2 / (gate^2 variance); above 1 the sensor must wait.
  double ratio(double innovation, double gate_sigma) const noexcept {
    const double share = age_s_ / memory_s;
    const double deviation = innovation - (1.0 - share) * offset_;
    return deviation * deviation / (gate_sigma * gate_sigma * (narrow_ + share * (wide_ - narrow_)));
  }

 private:
  static constexpr double memory_s = 3600.0;
  double offset_ = 0.0, narrow_ = 1.0, wide_ = 1.0, age_s_ = 0.0;
};

}  // namespace ehm::monitor
