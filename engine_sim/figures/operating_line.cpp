#include "engine_sim/figures/operating_line.h"

namespace ehm::engine {
namespace {

constexpr double idle_share = 0.07;
constexpr int steps = 120;
constexpr FlightCondition cruise{10668.0, 0.8, 0.0};
constexpr double cruise_t40_k = 1308.6;

std::vector<SteadyPoint> points_down_from(const Turbofan& engine, const FlightCondition& flight,
                                          const Demand& maximum) {
  std::vector<SteadyPoint> points{solve_steady(engine, flight, {}, maximum)};
  const double full_n = points.front().gas.net_thrust_n;
  for (int i = 1; i <= steps; ++i) {
    const double share = 1.0 - (1.0 - idle_share) * i / steps;
    const SteadyPoint above = points.back();
    points.push_back(solve_steady(engine, flight, {}, {DemandKind::net_thrust_n, share * full_n}, &above));
  }
  return points;
}

}  // namespace

std::vector<OperatingLine> operating_lines(const Turbofan& engine) {
  const DesignPoint& design = engine.data().design;
  return {{"sea level static",
           points_down_from(engine, design.flight, {DemandKind::fuel_flow_kg_s, design.fuel_flow_kg_s})},
          {"10668 m Mach 0.8", points_down_from(engine, cruise, {DemandKind::t40_k, cruise_t40_k})}};
}

}  // namespace ehm::engine
