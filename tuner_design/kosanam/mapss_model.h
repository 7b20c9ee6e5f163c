// SPDX-License-Identifier: Apache-2.0
#pragma once
// The engine of the theses by Endurthi and Kosanam's group with published matrices: MAPSS, a low-bypass military
// turbofan, 3 states, 3 controls, 8 health parameters, 11 sensors, discrete, with process noise and sensor noise.
//
// Source: D. Simon, sensor selection problem, matrices.mat (2004), as it stands in the public repository
// lchauhan8642/Benchmark-using-BBO-PSO-GA, rounded to 10 digits. The file names neither its channels nor its sample
// time. *Reading*: the health parameters are in the order of Kosanam's list (section 3.3), which has as many; one
// sample is 0.1 s, which makes the spools' time constants 1 s and the metal's 13 s. Health in fractions. Errors: none.

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::tuner_design {

linear_model::LinearModel mapss_model();

/// Of health, fractions squared a sample, in the same file: (5e-5)^2.
inline constexpr double mapss_health_variance = 2.5e-9;

}  // namespace ehm::tuner_design
