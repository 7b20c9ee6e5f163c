// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/linear_model/discretise.h"

#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

namespace ehm::linear_model {

LinearModel discretise(const LinearModel& model) {
  if (model.discrete) return model;
  const Eigen::Index n = model.A.rows(), nu = model.B.cols(), p = model.L.cols();
  Eigen::MatrixXd generator = Eigen::MatrixXd::Zero(n + nu + p, n + nu + p);
  generator.topRows(n) << model.A, model.B, model.L;
  const Eigen::MatrixXd transition = (generator * model.sample_time_s).exp();
  if (!transition.allFinite()) {
    throw std::runtime_error("zero-order hold of [A B L]: the exponential is not finite; sample_time_s " +
                             std::to_string(model.sample_time_s) + " is too long for this A");
  }
  LinearModel result = model;
  result.discrete = true;
  result.A = transition.topLeftCorner(n, n);
  result.B = transition.block(0, n, n, nu);
  result.L = transition.topRightCorner(n, p);
  return result;
}

}  // namespace ehm::linear_model
