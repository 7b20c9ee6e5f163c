// SPDX-License-Identifier: Apache-2.0
#pragma once
// The EGT margin of an engine: what its T48 has left below the rating at take-off on a hot day, by the engine model at
// what a flight has taught.
//   margin = T48max - T48(h, c) - T_c c      at hot_day, with the take-off thrust of the engine as filed, no off-take
//   sigma^2 = g' P g,   g = [dT48/dh, T_c]   T_c: by which each cause of the build at its sigma moves T48
//   thrust margin: what Fn could grow by there, as a share, until the margin is used up; sigma by the same slope
// Health by central differences of half a percent; the metal is in balance, what instruments misread changes no engine.
// Errors: @throws engine_sim::SolveError where the engine does not reach the thrust (says so). Solves some 40 steady
// points, each in some tenths of a millisecond: not for the cycle path.

#include "engine_sim/model/solve/steady.h"
#include "monitor/onboard/learned.h"

namespace ehm::onboard {

/// Sea level, end of the take-off run, the corner of flat rating.
inline constexpr engine_sim::FlightCondition hot_day{0.0, 0.25, 15.0};
/// Take-off power of an engine as filed, as a share of its design point's corrected fan speed.
inline constexpr double take_off_power = 1.0;

struct TakeOffMargin {
  double margin_k, sigma_k;
  double thrust, thrust_sigma;  ///< the thrust margin
};

/// The thrust that the engine as filed has there.
double take_off_thrust_n(const engine_sim::Turbofan& filed);
/// Of an engine that is known: T48max - T48, K.
double egt_margin_k(const engine_sim::Turbofan& engine, const engine_sim::HealthVector& health, double net_thrust_n);
TakeOffMargin take_off_margin(const OnBoardModel& model, const Learned& learned);

}  // namespace ehm::onboard
