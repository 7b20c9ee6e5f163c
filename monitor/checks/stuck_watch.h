// SPDX-License-Identifier: Apache-2.0
#pragma once
// Is a sensor frozen? Told by values that repeat to the last bit, more of them than a healthy sensor of its kind shows.
//
//   stated     resolution q and noise s (before rounding) are known. A value in the middle of its step repeats with the
//              largest probability
//                p = erf(q / (sqrt(8) s)),       limit: the least n with p^(n-1) <= 1e-12
//              q = s: 30, q = 2 s: 74, q = 4 s: 595 values; from q = 8 s on there is no limit: equality tells nothing
//   not stated the sensor itself shows it. Its longest run of equal values, six times over, is the limit, once it has
//              changed 32 times. But a sensor whose values hardly move by more than their smallest step to and fro is
//              coarse for its noise, may stand still for any time, and has no limit; and one that never changed has not
//              shown that it would. The fault detector still finds either when the engine moves and they do not.
//   held       a sensor that is updated more slowly than samples come holds each value for n samples: stated, or the
//              shortest run of a noisy one. The limit is in updates then.
//
// A run is at least `least` samples long before it counts; an operator's own limit replaces all of this. A frozen
// sensor whose values still differ is quiet_watch.h's. Real-time safe: yes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace ehm::monitor {

/// What is known of a sensor beforehand.
struct SensorKind {
  double noise_sigma = 0.0;           ///< s
  double resolution = 0.0;            ///< q; 0: not stated
  std::int64_t update_samples = 0;    ///< n; 0: not stated
  std::int64_t least = 20;            ///< shortest run that may count as frozen
  std::int64_t operators_limit = -1;  ///< samples; 0: never; -1: by the rule above
};

class StuckWatch {
 public:
  static constexpr std::int64_t never = 0;

  explicit StuckWatch(const SensorKind& kind) : kind_(kind), updates_(stated_limit(kind)) { set_limit(); }

  /// Values in a row, of a sensor that speaks at each sample, that are no coincidence any more; `never` where equality
  /// tells nothing.
  static std::int64_t stated_limit(const SensorKind& kind) {
    const double p = std::erf(kind.resolution / (std::sqrt(8.0) * kind.noise_sigma));
    if (!(p > 0.0)) return kind.least;
    if (p >= 1.0) return never;
    const double n = 1.0 + std::log(negligible) / std::log(p);
    return n < longest_limit ? std::max<std::int64_t>(kind.least, std::llround(std::ceil(n))) : never;
  }

  /// A plausible value, `steps` sample times after the last one.
  void take(double value, int steps) noexcept {
    fresh_ = true;
    if (run_ == 0) {
      last_ = value;
      run_ = 1;
      return;
    }
    if (value == last_) {
      run_ += steps;
      since_fresh_ += steps;
      fresh_ = since_fresh_ >= hold();
    } else {
      learn(value - last_);
      last_ = value;
      run_ = 1;
    }
    if (fresh_) since_fresh_ = 0;
  }
  bool frozen() const noexcept { return limit_ != never && run_ >= limit_; }
  /// Equal values in a row, and how many are frozen.
  std::int64_t run() const noexcept { return run_; }
  std::int64_t limit() const noexcept { return limit_; }
  /// Samples for which each value is held.
  std::int64_t hold() const noexcept {
    if (kind_.update_samples > 0) return kind_.update_samples;
    return changes_ >= enough_for_hold && noisy_ >= least_noisy ? std::min(now_.shortest, before_.shortest) : 1;
  }
  /// The value is news: not one that the sensor still holds. A design that knows of the hold has it in its noise, and
  /// takes every value as news.
  bool fresh() const noexcept { return fresh_ || kind_.update_samples > 0; }
  /// Of another source or time: the run begins anew, what the sensor has shown of itself stays.
  void restart() noexcept { run_ = 0; }

 private:
  struct Runs {
    std::int64_t count = 0, shortest = std::numeric_limits<std::int64_t>::max(), longest = 0;
  };

  void learn(double step) noexcept {
    if (now_.count == window) {
      before_ = now_;
      now_ = {};
    }
    ++now_.count;
    now_.shortest = std::min(now_.shortest, run_);
    now_.longest = std::max(now_.longest, run_);
    changes_ = std::min<std::int64_t>(changes_ + 1, window);
    finest_ = std::min(finest_, std::abs(step));
    const bool to_and_fro = step * last_step_ < 0.0 && std::min(std::abs(step), std::abs(last_step_)) > 1.5 * finest_;
    noisy_ += ((to_and_fro ? 1.0 : 0.0) - noisy_) / memory;
    last_step_ = step;
    set_limit();
  }

  void set_limit() noexcept {
    const bool stated = kind_.resolution > 0.0;
    if (kind_.operators_limit >= 0) {
      limit_ = kind_.operators_limit;
    } else if (stated && (updates_ == never || kind_.update_samples > 0)) {
      limit_ = updates_ * kind_.update_samples;
    } else if (changes_ < enough_for_limit || (!stated && noisy_ < least_noisy)) {
      limit_ = never;
    } else {
      const std::int64_t longest = std::max(now_.longest, before_.longest);
      limit_ = std::max({kind_.least, runs * longest, stated ? updates_ * hold() : 0});
    }
  }

  static constexpr double negligible = 1e-12, longest_limit = 1e5;
  static constexpr double memory = 32.0;      // changes over which noisiness is averaged
  static constexpr double least_noisy = 0.1;  // share of the changes; reached where the noise is about one resolution
  static constexpr std::int64_t runs = 6, window = 128, enough_for_limit = 32, enough_for_hold = 8;

  SensorKind kind_;
  std::int64_t updates_;
  std::int64_t run_ = 0, since_fresh_ = 0, changes_ = 0, limit_ = never;
  double last_ = 0.0, last_step_ = 0.0, noisy_ = 0.0;
  double finest_ = std::numeric_limits<double>::infinity();
  Runs now_, before_;
  bool fresh_ = true;
};

}  // namespace ehm::monitor
