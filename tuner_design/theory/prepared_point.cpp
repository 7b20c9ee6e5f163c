// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/theory/prepared_point.h"

#include <numeric>

#include "engine_sim/linear_model/discretise.h"

namespace ehm::tuner_design {

PreparedPoint prepare(const linear_model::LinearModel& model) {
  PreparedPoint point;
  point.scaling = linear_model::scaling_of(model);
  point.model = linear_model::scaled(discretise(model), point.scaling);
  point.steady = estimation::steady_gain(point.model);
  return point;
}

std::vector<int> all_sensors(const linear_model::LinearModel& model) {
  std::vector<int> all(model.sensors.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace ehm::tuner_design
