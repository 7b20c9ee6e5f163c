// SPDX-License-Identifier: Apache-2.0
#pragma once
// What one channel of a source has shown so far, without any idea of what it should show.
//
//   mean   over all good values                  noise   sqrt( sum (v[k] - v[k-1])^2 / (2 n) ), blind to slow changes

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace ehm::monitor {

struct ChannelRecord {
  std::uint64_t good = 0;        ///< finite, and vouched for by the source
  std::uint64_t invalid = 0;     ///< the source's validity bit was off
  std::uint64_t not_finite = 0;  ///< NaN or infinite although marked valid
  std::uint64_t longest_equal_run = 0;
  double last = std::numeric_limits<double>::quiet_NaN();
  double min = std::numeric_limits<double>::infinity(), max = -std::numeric_limits<double>::infinity();

  void hear(double value, bool valid) {
    if (!valid || !std::isfinite(value)) {
      ++(valid ? not_finite : invalid);
      return;
    }
    if (good > 0) sum_of_squared_steps_ += (value - last) * (value - last);
    equal_run_ = good > 0 && value == last ? equal_run_ + 1 : 1;
    longest_equal_run = std::max(longest_equal_run, equal_run_);
    last = value;
    min = std::min(min, value);
    max = std::max(max, value);
    mean_ += (value - mean_) / static_cast<double>(++good);
  }
  /// NaN without values.
  double mean() const { return good > 0 ? mean_ : std::numeric_limits<double>::quiet_NaN(); }
  /// NaN with fewer than two values.
  double noise() const {
    return good > 1 ? std::sqrt(0.5 * sum_of_squared_steps_ / static_cast<double>(good - 1))
                    : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  std::uint64_t equal_run_ = 0;
  double mean_ = 0.0, sum_of_squared_steps_ = 0.0;
};

}  // namespace ehm::monitor
