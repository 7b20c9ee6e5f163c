// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/full_order/limit_after.h"

#include <stdexcept>
#include <string>

#include "monitor/estimation/time_varying_filter.h"

namespace ehm::tuner_design {

design::ErrorByChannel limit_after(const linear_model::LinearModel& model, int samples, int window) {
  if (window < 1 || window > samples) {
    throw std::invalid_argument("limit after " + std::to_string(samples) + " samples: a window of " +
                                std::to_string(window) + "; allowed: 1 to the number of samples");
  }
  estimation::TimeVaryingFilter filter(estimation::full_order_model(model));
  const estimation::ActuatorVector still = Eigen::VectorXd::Zero(model.B.cols());
  const auto every_sensor = estimation::SensorMask{}.set();
  design::ErrorByChannel sum{Eigen::VectorXd::Zero(model.L.cols()), Eigen::VectorXd::Zero(model.F.rows())};
  for (int k = 0; k < samples; ++k) {
    if (k > 0) filter.predict(still);
    filter.update(every_sensor);
    if (k < samples - window) continue;
    sum.health += filter.health_variance();
    sum.auxiliary += filter.auxiliary_variance();
  }
  return {sum.health / window, sum.auxiliary / window};
}

}  // namespace ehm::tuner_design
