// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which design of an estimator serves the sensors that are available, where it has one for all, and one without each.

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/capacity.h"

namespace ehm::estimation {

inline constexpr int none_missing = -1, several_missing = -2;

/// The one sensor of `wanted` that is not available, none_missing or several_missing. Real-time safe: yes.
inline int only_missing(SensorMask wanted, SensorMask available) noexcept {
  const SensorMask absent = wanted & ~available;
  if (absent.none()) return none_missing;
  if (absent.count() > 1) return several_missing;
  int missing = 0;
  while (!absent[as_size(missing)]) ++missing;
  return missing;
}

}  // namespace ehm::estimation
