// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/theory/relative_error.h"

#include "tuner_design/theory/point_problem.h"
#include "tuner_design/theory/prepared_point.h"

namespace ehm::tuner_design {

RelativeError relative_error(const linear_model::LinearModel& model, const estimation::SteadyGain& steady,
                             const design::ErrorWeights& weights) {
  const PointProblem problem = make_point_problem(model, steady, all_sensors(model), weights);
  return {problem.health_weight, problem.auxiliary_weight};
}

}  // namespace ehm::tuner_design
