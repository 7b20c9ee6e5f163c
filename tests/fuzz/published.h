// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a cycle promises of whatever it has been fed: finite estimates, positive sigmas, counters that add up.

#include "monitor/cycle/monitor_cycle.h"
#include "tests/fuzz/require.h"

namespace ehm::fuzz {

inline void require_promises(const monitor::MonitorCycle& cycle) {
  const auto& c = cycle.counters();
  EHM_REQUIRE(c.received == c.processed + c.withheld + c.duplicated + c.reordered + c.malformed + c.foreign);
  const auto& result = cycle.result();
  EHM_REQUIRE((result.fused & result.rejected).none());
  if (!result.estimates) return;
  const estimation::Estimate& estimate = result.estimate;
  EHM_REQUIRE(estimate.health.allFinite() && estimate.auxiliary.allFinite() && estimate.tuners.allFinite());
  EHM_REQUIRE((estimate.health_sigma.array() > 0.0).all() && estimate.health_sigma.allFinite());
  EHM_REQUIRE((estimate.auxiliary_sigma.array() > 0.0).all() && estimate.auxiliary_sigma.allFinite());
}

}  // namespace ehm::fuzz
