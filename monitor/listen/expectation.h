// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the design expects of each sensor of a healthy fleet in steady state, with the actuators where they are:
//
//   expected_i = trim_i + (Hu du)_i       spread_i^2 = (H Ph H^T)_ii + R_ii + Lambda_ii + (0.01 size_i)^2
//
// H, Hu steady gains of health and actuators (estimation/steady_gain.h), Ph the fleet's health, R one sample's noise,
// Lambda what the linear model misses; the last term (size of the trim: scaling.h) is the design point's uncertainty.

#include <Eigen/Core>

#include "monitor/design/design.h"

namespace ehm::monitor {

struct Expectation {
  Eigen::VectorXd value, spread;  ///< a row a sensor, the sensor's unit
};

/// `actuators` in the order of the model's controls, absolute.
/// @throws std::runtime_error if the model has no steady state.
Expectation expect_sensors(const linear_model::LinearModel& model, const Eigen::VectorXd& actuators);

}  // namespace ehm::monitor
