// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the data path gives for one sample that was in order, and what it has counted since it was made. Plain data.

#include <array>
#include <cstdint>
#include <vector>

#include "monitor/estimation/estimate.h"

namespace ehm::monitor {

struct CycleCounters {
  std::uint64_t received = 0;   ///< every sample that came
  std::uint64_t processed = 0;  ///< led to estimates
  std::uint64_t lost = 0;       ///< gaps of the sequence
  std::uint64_t duplicated = 0, reordered = 0, malformed = 0;
  std::uint64_t foreign = 0;  ///< from a second source of the same engine
  /// Accepted, but no honest estimate: off design, no design for the sensors left, too far from the fleet.
  std::uint64_t withheld = 0;
  std::uint64_t sensor_rejections = 0;  ///< values that were not fused; words of flight and actuators replaced
  std::uint64_t restarts = 0;
};

struct CycleResult {
  bool estimates = false;   ///< estimates hold; where not, the reasons say why
  std::uint32_t flags = 0;  ///< idl::estimate_flag
  estimation::Estimate estimate;
  std::vector<estimation::Estimate> shadow;  ///< of the estimators in the order of estimator.shadow
  estimation::SensorMask rejected, fused;
  std::array<std::uint32_t, estimation::max_sensors> reason{};  ///< idl::reject_reason bits by sensor
  /// Of the watch filter: sensor units, their squares, and the test ratio of the gate; all 0 where no filter ran.
  estimation::SensorVector innovation, innovation_variance, ratio;
};

}  // namespace ehm::monitor
