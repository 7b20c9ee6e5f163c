// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/actuator_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::monitor {

Eigen::VectorXd actuator_reach(const linear_model::LinearModel& model) {
  const Eigen::Index n = model.A.rows(), nu = as_index(model.controls.size()), m = as_index(model.sensors.size());
  Eigen::VectorXd reach = Eigen::VectorXd::Constant(nu, std::numeric_limits<double>::infinity());
  if (n == 0 || nu == 0 || model.B.cols() != nu || model.D.cols() != nu) return reach;
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(n, n) - model.A;
  const Eigen::MatrixXd gain = model.D + model.C * rest.partialPivLu().solve(model.B);
  for (Eigen::Index i = 0; i < nu; ++i)
    for (Eigen::Index j = 0; j < m; ++j) {
      const double to_trim = std::abs(model.sensors[as_size(j)].trim / gain(j, i));
      if (std::isfinite(gain(j, i)) && to_trim > 0.0) reach(i) = std::min(reach(i), to_trim);
    }
  return reach;
}

}  // namespace ehm::monitor
