// SPDX-License-Identifier: Apache-2.0
#pragma once
// When a sensor that was left out for a bias beyond the point may come back: when the mean of its innovation, that of a
// filter which goes on without it, is no bias any more.
//   v <- v + g (innovation - v),  g = 1/mean_samples;   v_max the largest |v| in its first 6 s
//   back where |v| < max(least/2, min(1.5 S_ii^1/2, v_max/2)) for mean_samples
// least: the least bias that would have been found. Without the sensor nobody knows any more what it should read; S_ii
// holds that doubt. Within it, and at less than half of what the bias has been, the sensor is as good as the filter's
// own word for it, which is open to be taught by it again; a bias that stays keeps it out in the widest doubt.
// Real-time safe: yes. Errors: none; a value that is no number says nothing.

#include <algorithm>
#include <cmath>

#include "monitor/estimation/capacity.h"

namespace ehm::monitor {

class BiasReturn {
 public:
  static constexpr int mean_samples = 133;  ///< 2 s at 15 ms
  static constexpr int peak_samples = 3 * mean_samples;
  static constexpr double doubt_sigmas = 1.5;

  /// For a checkpoint: what it has seen of the sensor; -1: of none. The peak is known by then.
  struct Memory {
    int sensor = -1;
    double mean = 0.0, largest = 0.0, least = 0.0;
  };
  Memory memory() const noexcept { return {sensor_, mean_, largest_, least_}; }
  void remember(const Memory& memory) noexcept {
    sensor_ = memory.sensor;
    mean_ = memory.mean;
    largest_ = memory.largest;
    least_ = memory.least;
    looks_ = peak_samples;
    good_ = 0;
  }

  /// `least`: the least bias that would have been found, in the sensor's unit.
  void leave_out(int sensor, double bias, double least) noexcept {
    sensor_ = sensor;
    mean_ = bias;
    largest_ = std::abs(bias);
    looks_ = 0;
    least_ = 0.5 * std::abs(least);
    good_ = 0;
  }
  void forget() noexcept { sensor_ = -1; }
  /// Which sensor is still to be left out; -1: none.
  int sensor() const noexcept { return sensor_; }

  void look(const estimation::SensorVector& innovation, const estimation::SensorVector& variance) noexcept {
    if (sensor_ < 0) return;
    const double v = innovation(sensor_);
    if (!std::isfinite(v)) return;
    mean_ += (v - mean_) / mean_samples;
    if (++looks_ <= peak_samples) largest_ = std::max(largest_, std::abs(mean_));  // later ones are the engine's
    const double most = std::max(least_, std::min(doubt_sigmas * std::sqrt(variance(sensor_)), 0.5 * largest_));
    good_ = std::abs(mean_) < most ? good_ + 1 : 0;
    if (good_ >= mean_samples) sensor_ = -1;
  }

 private:
  int sensor_ = -1, good_ = 0, looks_ = 0;
  double mean_ = 0.0, largest_ = 0.0, least_ = 0.0;
};

}  // namespace ehm::monitor
