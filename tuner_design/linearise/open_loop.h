// SPDX-License-Identifier: Apache-2.0
#pragma once
// A plant (plant.h) left to itself, controls and health held at those of v:
//   after     the states integrated over a time by the classical Runge-Kutta method, fourth order, steps of 5 ms or less
//   settled   the states where dx/dt = 0, by Newton's method with central differences over the states
// Both return v with the states moved. Source: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, II.1.
// Errors: those of the plant; settled() @throws std::runtime_error if the states do not come to rest within 50 steps.

#include "tuner_design/linearise/plant.h"

namespace ehm::tuner_design {

Eigen::VectorXd after(const Plant& plant, Eigen::VectorXd v, double seconds);
Eigen::VectorXd settled(const Plant& plant, Eigen::VectorXd v);

}  // namespace ehm::tuner_design
