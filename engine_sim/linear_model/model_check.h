// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a linear model must be before anything is computed from it. Shapes: linear_model.h.

#include <string>

#include "engine_sim/linear_model/capacity.h"
#include "engine_sim/linear_model/linear_model.h"

namespace ehm::linear_model {

/// @throws FileError (`file`, key, value, allowed, what to do) if
///  - a list is empty where it may not be, or over the capacity of engine_sim/linear_model/capacity.h (of
///    `sensor_capacity`: a list of candidates may be longer than what flies),
///  - a name is empty or occurs twice in its list,
///  - a matrix has the wrong shape or an entry that is not finite,
///  - sample_time_s, a sigma or a noise_sigma is not above zero,
///  - process_noise is not symmetric or has a negative eigenvalue,
///  - a health unit is unknown, or an auxiliary output that is reported in percent has zero trim,
///  - A is unstable: spectral radius of 1 or more (discrete), or an eigenvalue with
///    real part of 0 or more (continuous).
void check_model(const LinearModel& model, const std::string& file, int sensor_capacity = max_sensors);

}  // namespace ehm::linear_model
