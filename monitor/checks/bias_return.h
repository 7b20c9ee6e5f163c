// SPDX-License-Identifier: Apache-2.0
#pragma once
// When a sensor that was left out for a bias beyond the point may come back: its innovation, that of a filter which
// goes on without it, must have a mean of less than half the least bias that is found.
//   v <- v + g (innovation - v),  g = 1/mean_samples;      back where |v| < least/2 for mean_samples
// Real-time safe: yes. Errors: none; a value that is no number says nothing.

#include <cmath>

#include "monitor/estimation/capacity.h"

namespace ehm::monitor {

class BiasReturn {
 public:
  static constexpr int mean_samples = 133;  ///< 2 s at 15 ms

  /// `least`: the least bias that would have been found, in the sensor's unit.
  void leave_out(int sensor, double bias, double least) noexcept {
    sensor_ = sensor;
    mean_ = bias;
    most_ = 0.5 * std::abs(least);
    good_ = 0;
  }
  void forget() noexcept { sensor_ = -1; }
  /// Which sensor is still to be left out; -1: none.
  int sensor() const noexcept { return sensor_; }

  void look(const estimation::SensorVector& innovation) noexcept {
    if (sensor_ < 0) return;
    const double v = innovation(sensor_);
    if (!std::isfinite(v)) return;
    mean_ += (v - mean_) / mean_samples;
    good_ = std::abs(mean_) < most_ ? good_ + 1 : 0;
    if (good_ >= mean_samples) sensor_ = -1;
  }

 private:
  int sensor_ = -1, good_ = 0;
  double mean_ = 0.0, most_ = 0.0;
};

}  // namespace ehm::monitor
