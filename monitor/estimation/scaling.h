#pragma once
// Scaled value = channel value / scale. Unscaled, the sensitivities span six decades; scaled they are of order one.
//   states      percent of |trim|; where the trim is 0: as it is
//   sensors     percent of |trim|; where the trim is 0: as it is if in percent or %, else in its noise sigma
//   health      percent: `fraction` or `-` times 100, `percent` or `%` as it is
//   auxiliary   reporting unit: temperature in K (K, degC; degR, degF times 5/9), margins in points (percent, %, point,
//               points; fraction, - times 100), everything else in percent of |trim|

#include <Eigen/Core>
#include <string>
#include <vector>

#include "monitor/estimation/linear_model.h"

namespace ehm::estimation {

struct Scaling {
  Eigen::VectorXd state, sensor, health, auxiliary;
  std::vector<std::string> auxiliary_unit;  ///< reporting unit of each auxiliary channel: "K", "points" or "percent"
};

/// One percent of a channel's trim, in its unit. A channel with trim 0 in percent or % counts as given in percent of
/// trim already: 1. Any other channel with trim 0: `without_trim`. Real-time safe: yes.
double percent_of_trim(const Channel& channel, double without_trim);

/// @throws std::invalid_argument if a health unit is unknown, or a channel that is reported in percent has zero trim.
Scaling scaling_of(const LinearModel& model);

/// The same model in scaled units: A -> s_x^-1 A s_x and so on; noise and covariance likewise. Controls stay as they
/// are.
LinearModel scaled(const LinearModel& model, const Scaling& scaling);

}  // namespace ehm::estimation
