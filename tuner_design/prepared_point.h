#pragma once
// A linear model made ready for design: discrete, scaled, with its steady gain.

#include "monitor/estimation/scaling.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::bench {

struct PreparedPoint {
  estimation::LinearModel model;  ///< discrete, scaled
  estimation::Scaling scaling;    ///< from the model as it was given
  estimation::SteadyGain steady;
};

/// @throws what discretise, scaling_of and steady_gain throw.
PreparedPoint prepare(const estimation::LinearModel& model);

/// 0 .. m-1.
std::vector<int> all_sensors(const estimation::LinearModel& model);

}  // namespace ehm::bench
