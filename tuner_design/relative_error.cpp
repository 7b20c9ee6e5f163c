#include "tuner_design/relative_error.h"

#include "tuner_design/prepared_point.h"
#include "tuner_design/search/point_problem.h"

namespace ehm::bench {

RelativeError relative_error(const estimation::LinearModel& model, const estimation::SteadyGain& steady,
                             const design::ErrorWeights& weights) {
  const PointProblem problem = make_point_problem(model, steady, all_sensors(model), weights);
  return {problem.health_weight, problem.auxiliary_weight};
}

}  // namespace ehm::bench
