// SPDX-License-Identifier: Apache-2.0
#pragma once
// The six unknowns of the flow balance at given spool speeds and fuel flow, all of order one.
//   bypass ratio W13/W21, R-line of each compressor map (1 = surge), expansion ratio of each turbine
// A solved set is the warm start of the next solution. Units: none. Errors: none.
// The box is where a physical solution can lie; a step stays small against the features of the maps.

#include <array>
#include <cmath>
#include <cstddef>

namespace ehm::engine_sim {

inline constexpr std::size_t flow_unknown_count = 6;

template <class S>
struct FlowUnknownsOf {
  S bypass_ratio;
  S r_line_fan, r_line_lpc, r_line_hpc;
  S pressure_ratio_hpt, pressure_ratio_lpt;
};

struct FlowUnknowns : FlowUnknownsOf<double> {};

namespace flow_unknown_box {
inline constexpr std::array<double, flow_unknown_count> lower{0.1, -1.0, -1.0, -1.0, 1.02, 1.02};
inline constexpr std::array<double, flow_unknown_count> upper{40.0, 8.0, 8.0, 8.0, 8.0, 12.0};
inline constexpr std::array<double, flow_unknown_count> largest_step{2.0, 0.3, 0.3, 0.3, 0.5, 1.0};
}  // namespace flow_unknown_box

inline std::array<double, flow_unknown_count> pack(const FlowUnknowns& u) {
  return {u.bypass_ratio, u.r_line_fan, u.r_line_lpc, u.r_line_hpc, u.pressure_ratio_hpt, u.pressure_ratio_lpt};
}

/// The first six of `x`, in the order of pack().
template <class S, std::size_t N>
FlowUnknownsOf<S> unpack(const std::array<S, N>& x) {
  static_assert(N >= flow_unknown_count);
  return {x[0], x[1], x[2], x[3], x[4], x[5]};
}

/// x + dx, if no component is larger than its largest step or leaves the box; otherwise false, and x is not to be used.
template <class Step>
bool advance(std::array<double, flow_unknown_count>& x, const Step& dx) {
  for (std::size_t i = 0; i < flow_unknown_count; ++i) {
    const double step = dx(static_cast<std::ptrdiff_t>(i)), moved = x[i] + step;
    if (!(std::abs(step) <= flow_unknown_box::largest_step[i])) return false;
    if (moved < flow_unknown_box::lower[i] || moved > flow_unknown_box::upper[i]) return false;
    x[i] = moved;
  }
  return true;
}

}  // namespace ehm::engine_sim
