// SPDX-License-Identifier: Apache-2.0
#pragma once
// Steady operating point: both spools in power balance, all flows closed, one demand met.
//   unknowns (9):  six of flow_unknowns.h, N1 and N2 and fuel flow relative to the design point
//   residuals (9): six flow balances, (turbine - absorbed power)/turbine power of both shafts,
//                  (demanded quantity - demand)/scale
// Newton's method with exact derivatives. Where it fails from the given start, the new engine is solved at a calm fan
// speed, then worn, re-set and loaded in steps at that speed, and then its operating line is followed by arc length,
// also where it turns back on the demand, until the demand is passed.
// Units SI, health as fractions. Source: Walsh & Fletcher, chapter 7 (off-design matching); pseudo-arclength
// continuation: Allgower & Georg, Introduction to Numerical Continuation Methods, chapters 2 and 6.

#include "engine_sim/model/turbofan.h"

namespace ehm::engine_sim {

/// limit_ratio: the largest of T40, T48, P30, speeds and corrected speeds over its limit (ratings.h); 1 is maximum
/// power.
enum class DemandKind { fuel_flow_kg_s, n1_rpm, net_thrust_n, t40_k, n2_rpm, limit_ratio };
inline constexpr std::array<std::string_view, 6> demand_names{"fuel_flow_kg_s", "n1_rpm", "net_thrust_n",
                                                              "t40_k",          "n2_rpm", "limit_ratio"};

struct Demand {
  DemandKind kind;
  double value;
};

struct SteadyPoint {
  Operation operation;
  GasPath gas;
  FlowUnknowns unknowns;
  int iterations;   ///< Newton steps, all stages together
  double residual;  ///< largest of the nine, relative
};

/// `operation`: all but the fuel flow is held; its fuel flow is ignored, the demand decides. `start`: a solved point
/// nearby, or none for a cold start.
/// @throws std::invalid_argument if demand or health are not finite or out of range (the message says which)
/// @throws std::out_of_range for a flight condition outside the atmosphere's or the inlet's range
/// @throws SolveError if no steady point is found; the message names the residual that did not close and its value
SteadyPoint solve_steady(const Turbofan& engine, const Operation& operation, const Demand& demand,
                         const SteadyPoint* start = nullptr);

/// The same without off-take and with geometry on schedule.
inline SteadyPoint solve_steady(const Turbofan& engine, const FlightCondition& flight, const HealthVector& health,
                                const Demand& demand, const SteadyPoint* start = nullptr) {
  return solve_steady(engine, Operation{.flight = flight, .health = health}, demand, start);
}

}  // namespace ehm::engine_sim
