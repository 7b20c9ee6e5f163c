// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is known of a health parameter without a sensor: wear only ever goes one way. With h_c the last constrained
// estimate the next one lies in
//
//   h_i <= h_c,i where wear lowers it (efficiencies, flow capacities of fan and compressors)
//   h_i >= h_c,i where wear raises it (flow capacities of turbines, whose nozzles erode and clearances open)
//
// until maintenance lifts it. Against its own last estimate such a bound is a ratchet: noise can only push it on
// (theory.md, "Constrained filters"); hence whoever calls take() does so with estimates that have settled, and with a
// margin behind them. p parameters, channel units. Sources: Simon & Simon, ASME GT2003-38584; directions: Chatterjee &
// Litt, NASA/TM-2003-212607 (wear over 6000 cycles). Errors: none. Real-time safe: yes, all but construction.

#include <limits>
#include <string_view>

#include "monitor/estimation/capacity.h"

namespace ehm::estimation {

/// Where wear takes a parameter: +1 up, -1 down, by its name: hpt_flow, lpt_flow, turbine_flow and their like rise.
constexpr double wear_direction(std::string_view name) noexcept {
  const bool flow = name.ends_with("flow"), turbine = name.starts_with("hpt") || name.starts_with("lpt") ||
                                                      name.starts_with("ipt") || name.starts_with("turbine");
  return flow && turbine ? 1.0 : -1.0;
}

class HealthConstraint {
 public:
  /// `direction`: +1 where wear raises a parameter, -1 where it lowers it, 0 where anything may happen.
  explicit HealthConstraint(const HealthVector& direction) : direction_(direction) { lift(); }

  /// Nothing is known any more: maintenance, another engine.
  void lift() noexcept {
    lower_.setConstant(direction_.size(), -std::numeric_limits<double>::infinity());
    upper_.setConstant(direction_.size(), std::numeric_limits<double>::infinity());
  }
  /// No parameter will be better than this one, nor than one before.
  void take(const HealthVector& constrained) noexcept {
    for (Eigen::Index i = 0; i < direction_.size(); ++i) {
      if (direction_(i) < 0.0 && constrained(i) < upper_(i)) upper_(i) = constrained(i);
      if (direction_(i) > 0.0 && constrained(i) > lower_(i)) lower_(i) = constrained(i);
    }
  }

  [[nodiscard]] const HealthVector& direction() const noexcept { return direction_; }
  [[nodiscard]] const HealthVector& lower() const noexcept { return lower_; }
  [[nodiscard]] const HealthVector& upper() const noexcept { return upper_; }
  /// The finite side of each parameter's box, infinite where there is none: for a saved state.
  [[nodiscard]] HealthVector bounds() const noexcept { return (direction_.array() > 0.0).select(lower_, upper_); }

 private:
  HealthVector direction_, lower_, upper_;
};

}  // namespace ehm::estimation
