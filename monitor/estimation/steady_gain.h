// SPDX-License-Identifier: Apache-2.0
#pragma once
// Steady influence of health on state, sensors and auxiliary outputs with u = 0 ([SG] eq. 9 ff.):
//   X  = (I-A)^-1 L  (discrete)  or  -A^-1 L  (continuous)     n x p
//   H  = C X + M      m x p
//   Hz = F X + N      r x p

#include <Eigen/Core>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::estimation {

struct SteadyGain {
  Eigen::MatrixXd X, H, Hz;
};

/// @throws std::runtime_error if I - A (or A) is singular: the residual of the linear solve is named.
SteadyGain steady_gain(const linear_model::LinearModel& model);

}  // namespace ehm::estimation
