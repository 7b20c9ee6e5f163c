// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which noises share one variance, and where their search begins. A noise that no sensor sees, whose spectrum vanishes
// in every band, has no group. The groups are in the order of the terms: sensors, motion, walks. Errors: none.

#include "engine_sim/linear_model/linear_model.h"
#include "tuner_design/identify/whittle_fit.h"

namespace ehm::tuner_design {

/// A group for each term.
NoiseGroups one_each(const std::vector<SpectralBand>& bands, const std::vector<NoiseTerm>& terms);

/// The walks of `each` in one group, the last; no such group where there are none.
NoiseGroups common_walk(const NoiseGroups& each, const std::vector<NoiseTerm>& terms);

/// Sensors from the mean square `power` of d, all else from the model's, and above 0.
Eigen::VectorXd start_values(const NoiseGroups& groups, const std::vector<NoiseTerm>& terms,
                             const linear_model::LinearModel& scaled, const Eigen::VectorXd& power);

}  // namespace ehm::tuner_design
