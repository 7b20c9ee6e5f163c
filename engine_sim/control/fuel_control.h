// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fuel flow from a fan speed demand, by selection among loops in incremental form, so that none of them winds up:
//   loop y with limit or demand r:  e = (r - y)/y,   d ln Wf = (w/K) (T (e[k] - e[k-1]) + e[k] dt)
//   selection:  governor;  raised to the idle loop;  lowered to each limit loop;  then held within
//               deceleration(N2c) <= Wf/(Ps30 theta2^m) <= acceleration(N2c), the slew and the valve's range
// K and T are gain and lag of the linear model (control_data.h), w the bandwidth in rad/s: the zero of each loop
// cancels the engine's lag, the open loop is w/s. T goes with 1/delta2 and K with corrected fan speed, so the loops
// behave alike from sea level to the ceiling. T48 answers at once (T = 0): its loop is an integral one.
// What is not selected leaves no trace but its last error: a limit is left in the step in which its reason goes.
// A selection cuts the proportional answer to a step of r short, and an increment that is lost is lost; so the
// governor's r follows the demand from `reference_band` on, no faster than gives a stated rate of fuel flow. Small
// steps are then answered alike at all altitudes; large ones are the schedules' business.
// Source: Jaw & Mattingly, Aircraft Engine Controls, chapters 4 to 6 (min-max selection, Wf/Ps30 schedules).
// Errors: none; measurements must be finite. Real-time safe: yes.

#include <array>
#include <string_view>

#include "engine_sim/control/measurements.h"
#include "engine_sim/engines/control_data.h"

namespace ehm::engine_sim {

/// Which loop sets the fuel flow.
enum class FuelLoop {
  n1_governor,
  n2_idle,
  n1_limit,
  n2_limit,
  t48_limit,
  ps_30_limit,
  acceleration,
  deceleration,
  slew,
  valve_range
};
inline constexpr std::size_t fuel_loop_count = 10;
inline constexpr std::array<std::string_view, fuel_loop_count> fuel_loop_names{
    "N1 governor", "N2 idle",      "N1 limit",     "N2 limit", "T48 limit",
    "Ps30 limit",  "acceleration", "deceleration", "slew",     "valve range"};

class FuelControl {
 public:
  /// Starts in balance: `fuel_flow_kg_s` holds what is measured, and this fan speed is the demand.
  FuelControl(const ControlData& data, const Measurements& start, double fuel_flow_kg_s);

  /// Fuel flow that acts from now until the next call.
  double update(const Measurements& measured, double n1_demand_rpm, double dt_s);
  double fuel_flow_kg_s() const { return fuel_flow_kg_s_; }
  FuelLoop active() const { return active_; }

 private:
  static constexpr std::size_t regulator_count = 6;  // the first of FuelLoop
  void follow(const Measurements& measured, double n1_demand_rpm, double dt_s);
  std::array<double, regulator_count> errors(const Measurements& measured) const;
  std::array<double, regulator_count> increments(const Measurements& measured, double dt_s);

  ControlData data_;
  double fuel_flow_kg_s_;
  double n1_reference_rpm_;
  std::array<double, regulator_count> last_error_;
  FuelLoop active_ = FuelLoop::n1_governor;
};

}  // namespace ehm::engine_sim
