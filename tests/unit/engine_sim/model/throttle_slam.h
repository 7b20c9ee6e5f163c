// SPDX-License-Identifier: Apache-2.0
#pragma once
// The fuel flow of a throttle slam: idle, a straight ramp to maximum power, hold, the same ramp back, idle; repeated.
// Idle and maximum are those of ratings.h at one flight condition.

#include <algorithm>
#include <cmath>

#include "engine_sim/model/ratings.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim {

inline constexpr FlightCondition sea_level_static{0.0, 0.0, 0.0}, high_cruise{10668.0, 0.8, 0.0},
    ceiling{13500.0, 0.8, 0.0};
inline constexpr std::array<FlightCondition, 3> slam_flights{sea_level_static, high_cruise, ceiling};
inline constexpr std::array<double, 3> slam_ramps_s{1.0, 2.5, 5.0};

class ThrottleSlam {
 public:
  static constexpr double period_s = 18.0;

  ThrottleSlam(const Turbofan& engine, const FlightCondition& flight, double ramp_s) : ramp_s_(ramp_s) {
    const double tt2_k = intake(engine.data().inlet, flight).tt_k;
    idle_ = solve_steady(engine, flight, {}, {DemandKind::n2_rpm, idle_n2_rpm(engine.data().ratings, flight, tt2_k)});
    max_fuel_flow_kg_s_ = solve_steady(engine, flight, {}, {DemandKind::limit_ratio, 1.0}).gas.fuel_flow_kg_s;
  }

  const SteadyPoint& idle() const { return idle_; }
  double max_fuel_flow_kg_s() const { return max_fuel_flow_kg_s_; }

  Operation at(double time_s) const {
    const double t = std::fmod(time_s, period_s);
    const double share = std::clamp((t - 0.3) / ramp_s_, 0.0, 1.0) - std::clamp((t - 8.3) / ramp_s_, 0.0, 1.0);
    Operation operation = idle_.operation;
    operation.fuel_flow_kg_s += share * (max_fuel_flow_kg_s_ - operation.fuel_flow_kg_s);
    return operation;
  }

 private:
  double ramp_s_;
  SteadyPoint idle_;
  double max_fuel_flow_kg_s_;
};

}  // namespace ehm::engine_sim
