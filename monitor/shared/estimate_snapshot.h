// SPDX-License-Identifier: Apache-2.0
#pragma once
// The estimates of one engine as a display wants them, once a status, in single precision, and how each estimator that
// flies for it does. For metrics; who controls or judges by estimates reads EngineHealth and EngineAuxiliary.

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "idl/wire_names.h"
#include "monitor/cycle/monitor_cycle.h"

namespace ehm::monitor {

/// Of one estimator (cycle/estimator_tally.h), since the engine's filter was made.
struct EstimatorFigures {
  std::string_view name;  ///< of the table of estimators, which lives for ever
  bool published = false;
  std::uint64_t samples = 0, answers = 0;
  double spent_s = 0.0;
  float longest_s = 0.0f, innovation_ratio = 0.0f, difference = 0.0f;
};

struct EstimateSnapshot {
  bool present = false;  ///< there are estimates to show
  std::array<float, estimation::max_health> health{}, health_sigma{};
  std::array<float, estimation::max_auxiliary> auxiliary{}, auxiliary_sigma{};
  std::array<EstimatorFigures, idl::estimator_names.size() + 1> estimators{};
  std::size_t estimator_count = 0;  ///< 0 where the tuner filter flies alone
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
  cycle.for_each_tally([&](const EstimatorTally& tally) {
    snapshot.estimators[snapshot.estimator_count++] = {.name = tally.name,
                                                       .published = tally.name == cycle.published(),
                                                       .samples = tally.samples,
                                                       .answers = tally.answers,
                                                       .spent_s = 1e-9 * static_cast<double>(tally.spent_ns),
                                                       .longest_s = 1e-9f * static_cast<float>(tally.longest_ns),
                                                       .innovation_ratio = static_cast<float>(tally.innovation_ratio),
                                                       .difference = static_cast<float>(tally.difference)};
  });
  return snapshot;
}

}  // namespace ehm::monitor
