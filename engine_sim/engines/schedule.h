// SPDX-License-Identifier: Apache-2.0
#pragma once
// A schedule of the control: one value over one measured quantity, linear between its points, held outside.
// The points ascend strictly; there is one at least. Errors: none; NaN gives NaN. Real-time safe: yes.

#include <cmath>
#include <cstddef>
#include <vector>

namespace ehm::engine_sim {

struct SchedulePoint {
  double at, value;
};

using Schedule = std::vector<SchedulePoint>;

inline double scheduled(const Schedule& schedule, double at) {
  if (!(at > schedule.front().at)) return std::isnan(at) ? at : schedule.front().value;
  for (std::size_t i = 1; i < schedule.size(); ++i) {
    const SchedulePoint &a = schedule[i - 1], &b = schedule[i];
    if (at < b.at) return std::lerp(a.value, b.value, (at - a.at) / (b.at - a.at));
  }
  return schedule.back().value;
}

}  // namespace ehm::engine_sim
