// SPDX-License-Identifier: Apache-2.0
#pragma once
// The estimates of one engine as a display wants them: once a status, in single precision. For metrics; who controls or
// judges by estimates reads EngineHealth and EngineAuxiliary.

#include <algorithm>
#include <array>

#include "monitor/cycle/monitor_cycle.h"

namespace ehm::monitor {

struct EstimateSnapshot {
  bool present = false;  ///< there are estimates to show
  std::array<float, estimation::max_health> health{}, health_sigma{};
  std::array<float, estimation::max_auxiliary> auxiliary{}, auxiliary_sigma{};
};

/// In the design's units, with the standard deviation of the whole error. Real-time safe: yes.
inline EstimateSnapshot estimates_of(const MonitorCycle& cycle) noexcept {
  EstimateSnapshot snapshot;
  snapshot.present = cycle.result().estimates && !cycle.stale();
  const auto copy = [](const auto& from, auto& to) {
    std::transform(from.data(), from.data() + from.size(), to.begin(), [](double v) { return static_cast<float>(v); });
  };
  const estimation::Estimate& estimate = cycle.result().estimate;
  copy(estimate.health, snapshot.health);
  copy(estimate.health_sigma, snapshot.health_sigma);
  copy(estimate.auxiliary, snapshot.auxiliary);
  copy(estimate.auxiliary_sigma, snapshot.auxiliary_sigma);
  return snapshot;
}

}  // namespace ehm::monitor
