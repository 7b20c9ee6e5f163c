#pragma once
// One figure of merit for an estimator, from its expected squared errors by channel:
//   J = wh sum_i e_h,i + sum_i wz_i e_z,i,      wh = w_h / limit(h),   wz_i = w_z / limit(z)
// with the Bayes limits of the totals, so that J = w_h + w_z where nothing is left to gain. A limit of (nearly) zero
// cannot divide: what the fleet itself would give, tr Ph or tr Hz Ph Hz^T, stands in its place. Scaled units.

#include "monitor/design/design.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::bench {

struct RelativeError {
  double health = 0.0;        ///< wh
  Eigen::VectorXd auxiliary;  ///< wz

  [[nodiscard]] double operator()(const design::ErrorByChannel& error) const {
    return health * error.health.sum() + auxiliary.dot(error.auxiliary);
  }
};

/// Limits of all sensors of `model` (scaled). Weights: w_h and w_z, not negative.
RelativeError relative_error(const estimation::LinearModel& model, const estimation::SteadyGain& steady,
                             double health_weight = 1.0, double auxiliary_weight = 1.0);

}  // namespace ehm::bench
