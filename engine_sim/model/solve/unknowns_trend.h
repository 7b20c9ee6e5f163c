// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the flow unknowns change from one balance to the next along a flight, continued by the parabola through the last
// three changes: a good guess spares evaluations of the cycle.
//   d[k+1] = 3 d[k] - 3 d[k-1] + d[k-2],  x[k+1] = x[k] + d[k+1], kept inside the box of the unknowns
// Units: those of flow_unknowns.h. Errors: none. Source: Newton's backward differences; third differences taken as 0.

#include <algorithm>
#include <array>

#include "engine_sim/model/solve/flow_unknowns.h"

namespace ehm::engine_sim {

class UnknownsTrend {
 public:
  void add(const FlowUnknowns& from, const FlowUnknowns& to) {
    const auto a = pack(from), b = pack(to);
    before_last_but_one_ = last_but_one_;
    last_but_one_ = last_;
    for (std::size_t i = 0; i < flow_unknown_count; ++i) last_[i] = b[i] - a[i];
  }

  FlowUnknowns continued(const FlowUnknowns& from) const {
    auto x = pack(from);
    for (std::size_t i = 0; i < flow_unknown_count; ++i) {
      const double change = 3.0 * (last_[i] - last_but_one_[i]) + before_last_but_one_[i];
      x[i] = std::clamp(x[i] + change, flow_unknown_box::lower[i], flow_unknown_box::upper[i]);
    }
    return {unpack(x)};
  }

 private:
  using Change = std::array<double, flow_unknown_count>;
  Change last_{}, last_but_one_{}, before_last_but_one_{};  ///< zero at first: the flight starts steady
};

}  // namespace ehm::engine_sim
