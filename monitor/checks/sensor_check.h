#pragma once
// What one sensor's value tells by itself, before any model is asked: validity bit, finite, range, rate, stuck.
//
// The result is a set of wire::reject_reason bits, 0 for a plausible value. Real-time safe: yes.

#include <cstdint>
#include <vector>

#include "monitor/estimation/linear_model.h"
#include "monitor/options.h"
#include "monitor/sample.h"

namespace ehm::monitor {

class SensorCheck {
 public:
  /// Range and rate of a sensor whose trim is 0 scale with its noise instead: 1 % of trim counts as one sigma there.
  SensorCheck(const CheckOptions& options, const estimation::LinearModel& model);

  /// `steps` sample times lie between this value and the last one.
  std::uint32_t reasons(const Sample& sample, int sensor, int steps) noexcept;
  void reset() noexcept;

 private:
  struct Memory {
    double last = 0.0;
    bool has_last = false;
    std::int64_t equal = 0;  ///< values in a row equal to `last`
  };

  CheckOptions options_;
  std::vector<double> trim_, percent_;  ///< trim and what one percent is, by sensor
  std::vector<Memory> memory_;
};

}  // namespace ehm::monitor
