#pragma once
// What a linear model must be before anything is computed from it. Shapes are in monitor/estimation/linear_model.h.

#include <string>

#include "monitor/estimation/capacity.h"
#include "monitor/estimation/linear_model.h"

namespace ehm::design {

/// @throws FileError (`file`, key, value, allowed, what to do) if
///  - a list is empty where it may not be, or over the capacity of monitor/estimation/capacity.h (of `sensor_capacity`:
///    a list of candidates may be longer than what flies),
///  - a name is empty or occurs twice in its list,
///  - a matrix has the wrong shape or an entry that is not finite,
///  - sample_time_s, a sigma or a noise_sigma is not above zero,
///  - process_noise is not symmetric or has a negative eigenvalue,
///  - a health unit is unknown, or an auxiliary output that is reported in percent has zero trim,
///  - A is unstable: spectral radius of 1 or more (discrete), or an eigenvalue with
///    real part of 0 or more (continuous).
void check_model(const estimation::LinearModel& model, const std::string& file,
                 int sensor_capacity = estimation::max_sensors);

}  // namespace ehm::design
