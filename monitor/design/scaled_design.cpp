// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/scaled_design.h"

#include "engine_sim/linear_model/discretise.h"
#include "engine_sim/linear_model/scaling.h"

namespace ehm::design {

linear_model::LinearModel discrete_scaled(const Design& design) {
  const linear_model::LinearModel& model = design.model;
  return linear_model::scaled(model.discrete ? model : linear_model::discretise(model), design.scaling);
}

estimation::ChannelUnits units_of(const Design& design) {
  const linear_model::LinearModel& model = design.model;
  return {trims(model.sensors),  design.scaling.sensor,  trims(model.controls),   trims(model.health),
          design.scaling.health, trims(model.auxiliary), design.scaling.auxiliary};
}

}  // namespace ehm::design
