// SPDX-License-Identifier: Apache-2.0
#pragma once
// The scheduled sensor faults of a flight, handed out as their time comes.

#include <algorithm>
#include <utility>
#include <vector>

#include "engine_sim/scenario/scenario.h"

namespace ehm::engine_sim {

class FaultSchedule {
 public:
  explicit FaultSchedule(std::vector<ScheduledFault> faults) : pending_(std::move(faults)) {
    std::stable_sort(pending_.begin(), pending_.end(),
                     [](const auto& a, const auto& b) { return a.fault.start_s < b.fault.start_s; });
  }

  /// Those that begin by now and have not been handed out, in the order of their begin.
  std::vector<ScheduledFault> due(double time_s) {
    const auto first_later = std::find_if(pending_.begin(), pending_.end(),
                                          [&](const ScheduledFault& f) { return f.fault.start_s > time_s; });
    std::vector<ScheduledFault> due(pending_.begin(), first_later);
    pending_.erase(pending_.begin(), first_later);
    return due;
  }

 private:
  std::vector<ScheduledFault> pending_;
};

}  // namespace ehm::engine_sim
