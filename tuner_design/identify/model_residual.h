// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the actuators do not explain of the sensors, sample to sample:
//
//   xu[k+1] = A xu + B u,  xu[0] = (I - A)^-1 B u[0]        e[k] = (y[k] - trim) / scale - (C xu[k] + D u[k])
//   d[k] = e[k+1] - e[k] - mean                             m x (N - 1), percent of trim
//
// d is stationary although health walks, and needs no start of a filter. The engine's control may react to the sensors'
// noise: u is what acted, as measured, and e is free of it all the same. The mean is taken out, so that a steady drift
// is no noise. A, B, C, D discrete and scaled. Errors: none; A is stable (linear_model::check_model).

#include "engine_sim/linear_model/linear_model.h"
#include "tuner_design/identify/recorded_samples.h"

namespace ehm::tuner_design {

/// `scaled` has the record's controls, and of its sensors those of `sensors`; `sensor_scale` is of these. At least two
/// samples.
Eigen::MatrixXd differenced_residual(const RecordedSamples& record, const Span& span,
                                     const linear_model::LinearModel& scaled, const std::vector<int>& sensors,
                                     const Eigen::VectorXd& sensor_scale);

}  // namespace ehm::tuner_design
