// SPDX-License-Identifier: Apache-2.0
#pragma once
// A design's model as the estimators of its point compute with it, discrete and scaled
// (engine_sim/linear_model/scaling.h), and the way back to channel units. Errors: those of linear_model::discretise.

#include "monitor/design/design.h"
#include "monitor/estimation/channel_units.h"

namespace ehm::design {

linear_model::LinearModel discrete_scaled(const Design& design);
estimation::ChannelUnits units_of(const Design& design);

}  // namespace ehm::design
