// SPDX-License-Identifier: Apache-2.0
#pragma once
// Scaled value = channel value / scale. Unscaled, the sensitivities span six decades; scaled they are of order one.
//   states      percent of the trim; where it has no size: as it is
//   sensors     percent of the trim; where it has no size: as it is if in percent or %, else in its noise sigma
//   health      percent: `fraction` or `-` times 100, `percent` or `%` as it is
//   auxiliary   reporting unit: temperature in K (any unit of temperature), margins in points (percent, %, point,
//               points; fraction, - times 100), gauge pressures as they are, everything else in percent of the trim
//
// The size of a trim is its magnitude on an absolute scale, |trim| for most units. A temperature's is counted from
// absolute zero, whatever the zero of its unit: 4 degC is 277.15 K, and one percent of it 2.77 degC. A gauge pressure
// has none, since the ambient one is not known; nor has a trim of 0. Results do not depend on the zero of a unit then.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::linear_model {

struct Scaling {
  Eigen::VectorXd state, sensor, health, auxiliary;
  std::vector<std::string>
      auxiliary_unit;  ///< reporting unit of each auxiliary channel: "K", "points", "percent", or the
                       ///< channel's own gauge pressure
};

/// The size of a channel's trim in its unit; 0 where it has none. Real-time safe: yes.
double size_of_trim(const Channel& channel) noexcept;

/// One in the unit of a health parameter: 1 of a fraction, 100 of percent. @throws as scaling_of.
double unit_of_health(const Channel& parameter);

/// One percent of a channel's trim, in its unit. A channel in percent or % whose trim has no size counts as given in
/// percent of trim already: 1. Any other one: `without_trim`. Real-time safe: yes.
double percent_of_trim(const Channel& channel, double without_trim);

/// @throws std::invalid_argument if a health unit is unknown, or a channel that is reported in percent has a trim of 0.
Scaling scaling_of(const LinearModel& model);

/// The same model in scaled units: A -> s_x^-1 A s_x and so on; noise and covariance likewise. Controls stay as they
/// are.
LinearModel scaled(const LinearModel& model, const Scaling& scaling);

}  // namespace ehm::linear_model
