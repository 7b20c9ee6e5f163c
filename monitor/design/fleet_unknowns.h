// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is unknown of an engine but constant, as k independent unknowns e of unit variance: its health, and what its
// nonlinearity adds where the model knows it.
//
//   h = Gh e (p x k),   steady sensors Gy e (m x k),   outputs Gz e (r x k)
//   Gh = [Ph^1/2, 0],   [Gy; Gz] = [[H; Hz] Ph^1/2, Lambda^1/2]     k = p, or p + m + r with Lambda
//
// Scaled units. Source: theory.md, section 4.

#include <Eigen/Core>

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::design {

struct FleetUnknowns {
  Eigen::MatrixXd health, sensors, auxiliary;  ///< Gh, Gy of every sensor, Gz
};

/// `model` scaled, `steady` its steady gain.
FleetUnknowns fleet_unknowns(const linear_model::LinearModel& model, const estimation::SteadyGain& steady);

}  // namespace ehm::design
