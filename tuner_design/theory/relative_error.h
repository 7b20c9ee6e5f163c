// SPDX-License-Identifier: Apache-2.0
#pragma once
// One figure of merit for an estimator, from its expected squared errors by channel:
//   J = wh sum_i e_h,i + sum_i wz_i e_z,i
// with the weights of the search (point_problem.h): over the Bayes limits of the totals, or over what the fleet
// itself gives where a limit vanishes. Scaled units.

#include "monitor/design/design.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::tuner_design {

struct RelativeError {
  double health = 0.0;        ///< wh
  Eigen::VectorXd auxiliary;  ///< wz

  [[nodiscard]] double operator()(const design::ErrorByChannel& error) const {
    return health * error.health.sum() + auxiliary.dot(error.auxiliary);
  }
};

/// Limits of all sensors of `model` (discrete and scaled). @throws what make_point_problem throws.
RelativeError relative_error(const linear_model::LinearModel& model, const estimation::SteadyGain& steady,
                             const design::ErrorWeights& weights = {});

}  // namespace ehm::tuner_design
