// SPDX-License-Identifier: Apache-2.0
#pragma once
// A linear model made ready for design: discrete, scaled, with its steady gain.

#include "engine_sim/linear_model/scaling.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::tuner_design {

struct PreparedPoint {
  linear_model::LinearModel model;  ///< discrete, scaled
  linear_model::Scaling scaling;    ///< from the model as it was given
  estimation::SteadyGain steady;
};

/// @throws what discretise, scaling_of and steady_gain throw.
PreparedPoint prepare(const linear_model::LinearModel& model);

/// 0 .. m-1.
std::vector<int> all_sensors(const linear_model::LinearModel& model);

}  // namespace ehm::tuner_design
