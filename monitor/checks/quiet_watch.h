// SPDX-License-Identifier: Apache-2.0
#pragma once
// Is a sensor frozen though its values still differ? A word whose last bits toggle, or that a converter dithers,
// defeats the search for equal values (stuck_watch.h); but it has lost its noise. Told by the range of its values,
//
//   r = max - min over a window of 64 values
//
// beside the smallest range that the same sensor has shown while it was noisy: of 8 windows at least, of the last 64 at
// most. Frozen where r is below a quarter of that; 64 values of a normal deviate lie so close together once in 10^20.
// The engine's motion only widens a range. A window counts as noisy if its values go to and fro: a third of the steps
// at least reverse the one before, both larger than r / 64. So a sensor without noise, or one coarse for its noise, has
// no limit: the first shows no noise to lose, and the smallest range of the second is 0. Values that a slow sensor
// holds are left out by the caller. Real-time safe: yes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace ehm::monitor {

class QuietWatch {
 public:
  static constexpr std::size_t window = 64;

  /// A plausible value that is news.
  void take(double value) noexcept {
    const double step = value - last_;
    if (filled_ > 1 && step * last_step_ < 0.0)
      smaller_step_[reversals_++] = std::min(std::abs(step), std::abs(last_step_));
    low_ = filled_ == 0 ? value : std::min(low_, value);
    high_ = filled_ == 0 ? value : std::max(high_, value);
    last_step_ = step;
    last_ = value;
    if (++filled_ == window) conclude();
  }
  bool frozen() const noexcept { return frozen_; }
  /// Range of the latest window, and the least of a healthy one; 0 while that is not known.
  double range() const noexcept { return range_; }
  double least() const noexcept { return seen_ < enough ? 0.0 : share * std::min(now_, before_); }
  /// Of another source or time: the window begins anew, what the sensor has shown of itself stays.
  void restart() noexcept { filled_ = reversals_ = 0; }

 private:
  void conclude() noexcept {
    range_ = high_ - low_;
    frozen_ = range_ < least();
    if (!frozen_ && noisy()) learn();
    filled_ = reversals_ = 0;
  }
  bool noisy() const noexcept {
    const double least_step = range_ / window;
    return 3 * std::count_if(smaller_step_.begin(), smaller_step_.begin() + reversals_,
                             [&](double step) { return step > least_step; }) >
           static_cast<std::ptrdiff_t>(window);
  }
  void learn() noexcept {
    if (count_ == remembered) {
      before_ = now_;
      now_ = std::numeric_limits<double>::infinity();
      count_ = 0;
    }
    ++count_;
    seen_ = std::min(seen_ + 1, enough);
    now_ = std::min(now_, range_);
  }

  static constexpr double share = 0.25;
  static constexpr int enough = 8, remembered = 32;  // windows

  std::array<double, window> smaller_step_{};  ///< of the two that a reversal lies between
  std::ptrdiff_t reversals_ = 0;
  std::size_t filled_ = 0;
  double low_ = 0.0, high_ = 0.0, last_ = 0.0, last_step_ = 0.0, range_ = 0.0;
  double now_ = std::numeric_limits<double>::infinity(), before_ = now_;  ///< smallest ranges
  int count_ = 0, seen_ = 0;
  bool frozen_ = false;
};

}  // namespace ehm::monitor
