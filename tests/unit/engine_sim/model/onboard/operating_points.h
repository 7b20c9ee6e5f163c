// SPDX-License-Identifier: Apache-2.0
#pragma once
// Seeded points at which an on-board model may be asked: between idle and maximum over the envelope, worn, vanes, bleed
// valves and nozzle off their schedules, with off-take, the spools out of balance by some percent and the metal too.

#include "engine_sim/model/onboard/on_board_engine.h"
#include "engine_sim/model/ratings.h"
#include "engine_sim/model/solve/steady.h"
#include "tests/unit/engine_sim/model/envelope.h"

namespace ehm::engine_sim {

struct OperatingPoint {
  Operation operation;
  SpoolSpeeds speeds;
  MetalTemperatures metal;
  FlowUnknowns steady;  ///< solution of the steady point nearby
};

class OperatingPoints {
 public:
  OperatingPoints(const Turbofan& engine, std::uint64_t seed) : engine_(engine), random_(seed) {}

  OperatingPoint next() {
    while (true) {
      Operation o{.flight = random_.flight(), .health = random_.health()};
      o.geometry = {random_.uniform(-3.0, 5.0), random_.uniform(0.01, 0.1), random_.uniform(0.9, 1.1)};
      o.offtake = {random_.uniform(0.0, 1.0), random_.uniform(0.0, 5e4)};
      try {
        const OperatingPoint p = unbalanced(solve_steady(engine_, o, demand(o.flight)));
        FlowUnknowns unknowns = p.steady;
        engine_.gas_path(p.operation, p.speeds, unknowns, &p.metal);
        return p;
      } catch (
          const SolveError&) {  // this worn engine does not reach the demand, or not so far off balance: another one
      }
    }
  }

 private:
  Demand demand(const FlightCondition& flight) {
    if (random_.uniform(0.0, 1.0) < 0.7) return {DemandKind::limit_ratio, random_.uniform(0.75, 1.0)};
    const EngineData& data = engine_.data();
    return {DemandKind::n2_rpm, idle_n2_rpm(data.ratings, flight, intake(data.inlet, flight).tt_k)};
  }
  double about(double x, double share) { return x * random_.uniform(1.0 - share, 1.0 + share); }
  OperatingPoint unbalanced(const SteadyPoint& s) {
    OperatingPoint p{s.operation,
                     {about(s.gas.speeds.n1_rpm, 0.01), about(s.gas.speeds.n2_rpm, 0.01)},
                     {about(s.gas.s30.tt_k, 0.05), about(s.gas.s48.tt_k, 0.05), about(s.gas.s50.tt_k, 0.05)},
                     s.unknowns};
    p.operation.fuel_flow_kg_s = about(p.operation.fuel_flow_kg_s, 0.1);
    return p;
  }

  const Turbofan& engine_;
  envelope::Points random_;
};

/// What a deviation of each quantity counts relative to: its size, for rates a typical one, for stall margins 100 %.
inline GasPathQuantities<double> sizes_of(const GasPath& gas) {
  GasPathQuantities<double> size = quantities_of(gas);
  for (double& s : size) s = std::abs(s);
  std::fill_n(size.begin(), 2, 1000.0);
  std::fill_n(size.begin() + 2, metal_count, 10.0);
  std::fill(size.end() - 3, size.end(), 100.0);
  size[*gas_path_quantity::place("net_thrust_n")] = std::abs(gas.gross_thrust_n);
  return size;
}

}  // namespace ehm::engine_sim
