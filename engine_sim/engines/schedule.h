#pragma once
// A schedule of the control: one value over one measured quantity, linear between its points, held outside.
// The points ascend strictly. Errors: none; NaN gives NaN. Real-time safe: yes.

#include <array>
#include <cmath>
#include <cstddef>

namespace ehm::engine_sim {

struct SchedulePoint {
  double at, value;
};

template <std::size_t N>
using Schedule = std::array<SchedulePoint, N>;

template <std::size_t N>
double scheduled(const Schedule<N>& schedule, double at) {
  if (!(at > schedule.front().at)) return std::isnan(at) ? at : schedule.front().value;
  for (std::size_t i = 1; i < N; ++i) {
    const SchedulePoint &a = schedule[i - 1], &b = schedule[i];
    if (at < b.at) return std::lerp(a.value, b.value, (at - a.at) / (b.at - a.at));
  }
  return schedule.back().value;
}

}  // namespace ehm::engine_sim
