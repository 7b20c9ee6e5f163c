// SPDX-License-Identifier: Apache-2.0
#pragma once
// One fleet before one real monitor, for a while: what was lost, how late it was, what it cost.

#include <cstdint>
#include <string>

namespace ehm::tuner_design {

struct FleetOptions {
  std::string design, estimator = "tuner";  ///< of the monitor
  std::uint32_t domain = 45;
  std::uint32_t engines = 1;
  double seconds = 10.0, period_ms = 15.0;
};

struct FleetResult {
  std::uint32_t engines = 0;
  std::uint64_t sent = 0;             ///< samples, by every engine together
  std::uint64_t estimates = 0;        ///< EngineHealth that a subscriber received
  std::uint64_t lost = 0;             ///< gaps that the monitor saw in its input, and writes that were refused
  std::uint64_t late = 0;             ///< estimates later than one period
  double p50_us = 0.0;                ///< of the latency: median of the engines
  double p99_us = 0.0, max_us = 0.0;  ///< of the worst engine
  double cpu_percent = 0.0;           ///< of one processor, the monitor's share while the fleet flew
  double memory_mb = 0.0;             ///< resident

  bool lossless() const { return sent > 0 && estimates == sent && lost == 0; }
  double cpu_percent_per_engine() const { return cpu_percent / engines; }
};

/// @throws std::runtime_error if the processes do not find each other.
FleetResult fly_fleet(const FleetOptions& options);

}  // namespace ehm::tuner_design
