// SPDX-License-Identifier: Apache-2.0
#pragma once
// Has the noise of a sensor grown? Successive differences of its innovation, over the last 64 samples:
//
//   e = sum of min((nu[k] - nu[k-1])^2 / (2 S_ii), 8)
//
// Differences do not feel a bias, a drift or the engine's motion, and the cap makes one wild value harmless. For white
// noise e has mean N and variance 3 N (neighbouring differences share a value): 1.5 times a chi-square with 2 N / 3
// degrees of freedom. The threshold is its quantile at the stated rate of false alarms, one look a block and sensor.
// Twice the noise gives e of about 3 N, four times 6 N. Real-time safe: yes, after construction.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "monitor/diagnosis/quantiles.h"
#include "monitor/estimation/capacity.h"

namespace ehm::monitor {

class NoiseWatch {
 public:
  NoiseWatch(double false_alarm_per_hour, int sensors, double sample_time_s) : ring_(as_size(sensors)) {
    const double looks_per_hour = 3600.0 / sample_time_s * sensors;  // neighbouring blocks are nearly one look
    threshold_ = 1.5 * chi_square_quantile(block / 1.5, normal_quantile_above(false_alarm_per_hour / looks_per_hour));
  }

  void start() noexcept {
    energy_.fill(0.0);
    for (auto& ring : ring_) ring.fill(0.0);
    last_.fill(0.0);
    has_last_.reset();
    next_ = 0;
  }

  /// `innovation` over its sigma; `present` are the sensors that have one.
  void step(const estimation::SensorVector& innovation, estimation::SensorMask present) noexcept {
    for (std::size_t i = 0; i < as_size(innovation.size()); ++i) {
      const double nu = present[i] ? innovation(as_index(i)) : 0.0;
      const double difference = nu - last_[i];
      const double term = present[i] && has_last_[i] ? std::min(0.5 * difference * difference, cap) : 0.0;
      energy_[i] = std::max(0.0, energy_[i] + term - ring_[i][next_]);
      ring_[i][next_] = term;
      last_[i] = nu;
      has_last_[i] = present[i];
    }
    next_ = (next_ + 1) % block_samples;
  }

  bool loud(int sensor) const noexcept { return energy_[as_size(sensor)] > threshold_; }
  /// How many times the noise has grown, from what the capped differences show.
  double factor(int sensor) const noexcept { return std::sqrt(energy_[as_size(sensor)] / block); }
  double threshold_factor() const noexcept { return std::sqrt(threshold_ / block); }

 private:
  static constexpr std::size_t block_samples = 64;
  static constexpr double block = block_samples, cap = 8.0;
  std::vector<std::array<double, block_samples>> ring_;  ///< by sensor
  std::array<double, estimation::max_sensors> energy_{}, last_{};
  estimation::SensorMask has_last_;
  std::size_t next_ = 0;
  double threshold_ = 0.0;
};

}  // namespace ehm::monitor
