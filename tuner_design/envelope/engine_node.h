// SPDX-License-Identifier: Apache-2.0
#pragma once
// One node of a schedule: the nonlinear engine at a corrected fan speed, Mach number and T2, vanes and valves where its
// control has them, with nothing taken off; its derivatives are the best fit over engines of the fleet (fleet_fit.h),
// and
//   lambda^2 = mean over the fleet of (f - f0 - J (v - v0))^2,   f = [dx/dt; y; z],  v = [x; u; h]
// is what that misses, at each engine's own inputs. All reduced to sea level by the powers of the schedule.
// Errors: none; where the engine does not run, or more than one in ten of the fleet, the node is not valid.

#include <memory>

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/model/turbofan.h"
#include "monitor/schedule/schedule.h"

namespace ehm::tuner_design {

struct NodePlace {
  double n1_corrected_rpm, mach, t2_k;
};

struct NodeOptions {
  int fleet = 60;
  std::uint64_t seed = 1;
};

/// At this Mach number and T2, an altitude and an ambient temperature that the atmosphere knows.
engine_sim::FlightCondition flight_at(double mach, double t2_k);

/// `schedule`: whose similarity counts; its nodes are not looked at.
schedule::Node engine_node(const std::shared_ptr<const engine_sim::EngineDefinition>& engine,
                           const engine_sim::Turbofan& turbofan, const NodePlace& place,
                           const schedule::Schedule& schedule, const NodeOptions& options);

/// Only where the engine stands there, without derivatives: [x0 u0 y0 z0] reduced. Empty where it does not run.
Eigen::VectorXd engine_trim(const std::shared_ptr<const engine_sim::EngineDefinition>& engine,
                            const engine_sim::Turbofan& turbofan, const NodePlace& place,
                            const schedule::Schedule& schedule);

/// The powers of each channel's similarity by its unit; a fuel flow's is that of burnt heat.
schedule::Similarity similarity_of(const std::string& name, const std::string& unit);

}  // namespace ehm::tuner_design
