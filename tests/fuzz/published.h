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
  EHM_REQUIRE(cycle.filter().health().allFinite());
  EHM_REQUIRE(cycle.filter().auxiliary().allFinite());
  EHM_REQUIRE(cycle.filter().tuners().allFinite());
  EHM_REQUIRE((cycle.error().health_sigma().array() > 0.0).all() && cycle.error().health_sigma().allFinite());
  EHM_REQUIRE((cycle.error().auxiliary_sigma().array() > 0.0).all() && cycle.error().auxiliary_sigma().allFinite());
}

}  // namespace ehm::fuzz
