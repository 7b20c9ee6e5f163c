// SPDX-License-Identifier: Apache-2.0
#pragma once
// May an excluded sensor come back? Its value must fit what the filter predicts without it.
//
// The prediction without the sensor is biased by what only that sensor saw, so a fault of ten noise sigmas could hide
// in it. But at the moment of exclusion the full filter still predicted the sensor well: that offset is kept,
//   offset = (C xhat)_full,i - (C xhat)_without,i,      e = nu_i - offset,
// and three things must fit:
//   value   e^2                    <= gate^2 v            v: innovation variance
//   mean    (average of e)^2       <= least^2             least: half the bias it left with, 2.5 roots of v at most
//   spread  average of (e - mean)^2 <= 2 v                a sensor that left noisy
// with exponential averages over 50 samples. v and least grow from those of the full filter to the biased ones over an
// hour, the time in which wear may have moved. A health shift in between makes the offset worthless, and so does a
// filter that had not converged when the sensor left: the wide values then hold at once.
// Real-time safe: yes.

#include <algorithm>
#include <cmath>

namespace ehm::monitor {

class ReturnGate {
 public:
  /// In which wear may have moved, so that what the lost sensor had taught fades.
  static constexpr double memory_s = 3600.0;

  /// What a checkpoint keeps of it.
  struct Memory {
    double offset = 0.0, narrow_variance = 1.0, wide_variance = 1.0, age_s = 0.0, bias = 0.0;
  };
  Memory memory() const noexcept { return {offset_, narrow_, wide_, age_s_, bias_}; }
  void resume(const Memory& memory) noexcept {
    start(memory.offset, memory.narrow_variance, memory.wide_variance, memory.bias);
    age_s_ = std::min(memory_s, memory.age_s);
  }

  /// `bias` that it left with, 0 where none is known.
  void start(double offset, double narrow_variance, double wide_variance, double bias) noexcept {
    bias_ = bias;
    offset_ = offset;
    narrow_ = narrow_variance;
    wide_ = std::max(wide_variance, narrow_variance);
    const double most = most_sigmas * std::sqrt(narrow_variance);
    least_ = bias != 0.0 ? std::min(most, 0.5 * std::abs(bias)) : most;
    age_s_ = 0.0;
    innovation_mean_ = offset + bias;
    spread_ = narrow_variance;
  }
  /// The offset is worthless: only the wide values are left.
  void forget() noexcept { age_s_ = memory_s; }

  /// Takes the innovation of one plausible value.
  void observe(double innovation) noexcept {
    innovation_mean_ += (innovation - innovation_mean_) / averaged;
    const double about_mean = innovation - innovation_mean_;
    spread_ += (about_mean * about_mean - spread_) / averaged;
  }
  void step(double dt_s) noexcept { age_s_ = std::min(memory_s, age_s_ + dt_s); }

  /// Value or mean over what is allowed, squared, or the spread over its own; above 1 the sensor must wait.
  double ratio(double innovation, double gate_sigma) const noexcept {
    const double share = age_s_ / memory_s;
    const double variance = narrow_ + share * (wide_ - narrow_);
    const double gate = gate_sigma * gate_sigma;
    const double value = innovation - (1.0 - share) * offset_, mean = innovation_mean_ - (1.0 - share) * offset_;
    const double least = least_ * least_ + share * (gate * wide_ - least_ * least_);
    const double fit = std::max(value * value / (gate * variance), mean * mean / least);
    return spread_ > most_spread * narrow_ ? std::max(fit, spread_ / (most_spread * narrow_)) : fit;
  }

  /// Average innovation of the last samples: what the sensor reads beyond the prediction.
  double innovation_mean() const noexcept { return innovation_mean_; }

 private:
  static constexpr double averaged = 50.0, most_sigmas = 2.5, most_spread = 2.0;
  double offset_ = 0.0, narrow_ = 1.0, wide_ = 1.0, least_ = 1.0, age_s_ = 0.0, bias_ = 0.0;
  double innovation_mean_ = 0.0, spread_ = 1.0;
};

}  // namespace ehm::monitor
