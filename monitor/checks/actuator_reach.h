// SPDX-License-Identifier: Apache-2.0
#pragma once
// How far an actuator can be moved before the model loses its meaning: until some sensor has moved by the whole of its
// trim, at rest.
//   g     = D + C (I-A)^-1 B                        m x nu, discrete
//   reach_i = min_j |trim_j / g_ji|                 over the sensors that have a trim, units of the actuator
// It is the scale of an actuator whose own trim is 0, as bleed and shaft power are. Infinite where it moves no sensor,
// or where the model has no rest.
// Errors: none.

#include <Eigen/Core>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::monitor {

Eigen::VectorXd actuator_reach(const linear_model::LinearModel& model);

}  // namespace ehm::monitor
