// SPDX-License-Identifier: Apache-2.0
#pragma once
// Standard deviations of health and of the sensors' noise, and the process noise, from named variables or, where these
// do not state them, from the options in percent.
//   health sigma   health_sigma: a number for each parameter or one for all, in its unit
//   sensor noise   sensor_noise_sigma likewise, or R: m x m and diagonal, a vector of variances, or one variance
//   rounding       sensor_resolution, the step of a sensor's values in its unit, and sensor_update_period_s, the time
//                  between them: both optional, NaN where not known; they raise the noise (linear_model/sensor_noise.h)
//   process noise  Q per sample: n x n, a vector of variances, or one variance
// What is assumed in percent of trim needs a trim, or a channel in percent.

#include "tuner_design/import/import_model.h"
#include "tuner_design/import/variables.h"

namespace ehm::tuner_design {

/// `result` has its matrices and channels.
/// @throws files::FileError if a length is wrong, a sigma or variance is not above zero, R has entries off its
///         diagonal, Q is not symmetric, something is stated twice, or cannot be assumed for want of a trim.
void assemble_noise(const Variables& given, const ImportOptions& options, ImportedModel& result);

/// @throws files::FileError: what is `stated` and the `option` say the same thing, and one would have no effect.
[[noreturn]] void refuse_option(const Variables& given, const std::string& stated, const std::string& option);

}  // namespace ehm::tuner_design
