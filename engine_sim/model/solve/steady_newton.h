// SPDX-License-Identifier: Apache-2.0
#pragma once
// Newton's method on the nine steady balances from one start (steady.h says which), and the starts themselves.
// Internal to the steady solver: steady.cpp decides from where and in which steps a target is approached.

#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim::steady {

inline constexpr std::size_t unknown_count = flow_unknown_count + 3;
using Unknowns = std::array<double, unknown_count>;
/// Behind the six flow unknowns: N1, N2 and fuel flow relative to the design point.
enum Extra : std::size_t { n1 = flow_unknown_count, n2, fuel };

/// Where the engine is asked to be; the operation's fuel flow plays no part.
struct Target {
  Operation operation;
  Demand demand;
};

/// A plane in the space of the unknowns, sum of normal_i (x_i - through_i) = 0: it cuts the operating line at one place
/// and takes the demand's part, so that the line can be followed also where it turns back on every demand.
struct Plane {
  Unknowns through, normal;
};

struct Solution {
  Unknowns x;
  GasPath gas;
  int iterations;
  double residual;
};

/// @throws SolveError if the balances do not close from here
Solution solve_at(const Turbofan& engine, const Target& target, const Unknowns& x);
Solution solve_on(const Turbofan& engine, const Operation& operation, const Plane& plane, const Unknowns& x);

Unknowns unknowns_of(const Turbofan& engine, const FlowUnknowns& flow, const SpoolSpeeds& speeds,
                     double fuel_flow_kg_s);

/// The design point's unknowns moved to another inlet state at constant corrected speeds and corrected fuel flow.
Unknowns cold_start(const Turbofan& engine, const FlightCondition& flight);

/// What the solved gas path has of the demanded quantity.
double demanded_value(const Turbofan& engine, const GasPath& gas, DemandKind kind);

}  // namespace ehm::engine_sim::steady
