// SPDX-License-Identifier: Apache-2.0
#pragma once
// The linear model that serves a whole fleet best, and what it still misses.
//
// Engines with h ~ N(0, sigma^2), sigma of the engine file, run at the trim's fan speed (v and f: engine_channels.h):
//   states and controls   J_xu: derivative at each engine, averaged over the fleet
//   health                f(v) - J_xu (v - v0)_xu ~ f0 + J_h (h - h0)      least squares over the fleet
// In two steps, because in steady state core speed and fuel flow follow health: one fit of all columns would hand them
// the curvature over health, and the dynamics would be nobody's.
// Where the engine is curved or kinked over the fleet's spread (map lines change their spacing) this beats the tangent
// at the new engine; it is statistical linearisation. The trim moves to where the fitted engine is in balance. What is
// left is measured on the same fleet in steady state, as the filter meets it:
//   Lambda = E[r r^T],  r = [y; z] - trim - linear steady [y; z] under the engine's own fuel flow and health.

#include <cstdint>

#include "tuner_design/linearise/engine_channels.h"

namespace ehm::tuner_design {

/// v and f of one steady engine in each column, in `layout`.
struct Fleet {
  EngineLayout layout;
  Eigen::MatrixXd inputs, outputs;
};

/// @throws std::runtime_error if more than one engine in a hundred has no steady point.
Fleet steady_fleet(const EngineLayout& layout, const engine_sim::Turbofan& turbofan,
                   const engine_sim::SteadyPoint& trim, int engines, std::uint64_t seed);

/// Fitted trim and derivatives.
struct FleetFit {
  Eigen::VectorXd inputs, outputs;  ///< v and f of the fitted engine with the trim's health and fan speed, in balance
  Eigen::MatrixXd jacobian;
};

/// @throws std::runtime_error if the fleet is too small to tell the health parameters apart.
FleetFit fit_fleet(const engine_sim::Turbofan& turbofan, const engine_sim::SteadyPoint& trim, const Fleet& fleet);

/// Lambda of a continuous model with its trims, (m+r) x (m+r), channel units.
Eigen::MatrixXd linearisation_error(const linear_model::LinearModel& model, const Fleet& fleet);

}  // namespace ehm::tuner_design
