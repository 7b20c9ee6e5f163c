// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fan speed that a demand asks for. A demand of fan speed is itself; one of net thrust is converted by the new engine:
//   n1 = N1 of solve_steady(new engine, flight, net thrust), valves on schedule
// The control governs fan speed, for thrust cannot be measured: a worn engine gives a little other thrust at the same
// fan speed. Converted anew when the demand changes, or the flight condition by more than what a thousandth of thrust
// feels. Out of reach: above what the engine gives at its speed limit, that limit; below what it gives at the least
// fan speed where it runs, zero, and the idle loop decides.
// Units: rpm, N. Errors: @throws std::out_of_range for a flight condition outside atmosphere or inlet.
// Real-time safe: no, a steady point is solved (0.1 to some ms).

#include <optional>

#include "engine_sim/engines/control_data.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim {

class FanSpeedDemand {
 public:
  FanSpeedDemand(const Turbofan& engine, const ControlData& data) : engine_(engine), data_(data) {}

  /// `demand`: n1_rpm or net_thrust_n.
  /// @throws std::invalid_argument for another kind of demand
  double n1_rpm(const Demand& demand, const FlightCondition& flight);
  /// What the new engine gives at its limit of fan speed. @throws SolveError if it does not run there
  double most_net_thrust_n(const FlightCondition& flight);

 private:
  struct Converted {
    double net_thrust_n;
    FlightCondition flight;
    double n1_rpm;
  };
  double converted(double net_thrust_n, const FlightCondition& flight);
  double speed_limit_rpm(const FlightCondition& flight) const;
  SteadyPoint at_speed_limit(const FlightCondition& flight);

  const Turbofan& engine_;
  ControlData data_;
  std::optional<Converted> last_;
  std::optional<SteadyPoint> near_;
};

}  // namespace ehm::engine_sim
