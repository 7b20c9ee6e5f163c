// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/figures/operating_line.h"

#include <cmath>

#include "engine_sim/model/ratings.h"

namespace ehm::engine_sim {
namespace {

constexpr int steps = 120;
constexpr FlightCondition sea_level_static{0.0, 0.0, 15.0}, cruise{10668.0, 0.8, 0.0};

std::vector<SteadyPoint> from_maximum_to_idle(const Turbofan& engine, const FlightCondition& flight) {
  const double tt2_k = intake(engine.data().inlet, flight).tt_k;
  const SteadyPoint maximum = solve_steady(engine, flight, {}, {DemandKind::limit_ratio, 1.0});
  const SteadyPoint idle =
      solve_steady(engine, flight, {}, {DemandKind::n2_rpm, idle_n2_rpm(engine.data().ratings, flight, tt2_k)});
  std::vector<SteadyPoint> points{maximum};
  for (int i = 1; i <= steps; ++i) {
    const double n1_rpm = std::lerp(maximum.gas.speeds.n1_rpm, idle.gas.speeds.n1_rpm, static_cast<double>(i) / steps);
    const SteadyPoint above = points.back();
    points.push_back(solve_steady(engine, flight, {}, {DemandKind::n1_rpm, n1_rpm}, &above));
  }
  return points;
}

}  // namespace

std::vector<OperatingLine> operating_lines(const Turbofan& engine) {
  return {{"sea level static", from_maximum_to_idle(engine, sea_level_static)},
          {"10668 m Mach 0.8", from_maximum_to_idle(engine, cruise)}};
}

}  // namespace ehm::engine_sim
