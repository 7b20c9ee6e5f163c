// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/detectability.h"

#include <algorithm>

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::design {

Eigen::VectorXd slow_bias_detectability(const linear_model::LinearModel& model, const linear_model::Scaling& scaling,
                                        const SubsetDesign& full) {
  const linear_model::LinearModel engine = linear_model::scaled(model, scaling);
  const Eigen::MatrixXd H = estimation::steady_gain(engine).H;
  const Eigen::MatrixXd Ph = engine.health_sigma.cwiseAbs2().asDiagonal();
  const double samples = full.averaged_samples(model.sample_time_s);
  const Eigen::MatrixXd R = engine.sensor_noise_sigma.cwiseAbs2().asDiagonal();
  const Eigen::Index n = engine.C.cols();
  // J^T = (I - A)^-T C^T, with the discrete A of the filter
  const Eigen::MatrixXd slow = Eigen::MatrixXd::Identity(n, n) - full.A.topLeftCorner(n, n);
  const Eigen::MatrixXd J = slow.transpose().partialPivLu().solve(engine.C.transpose()).transpose();
  const Eigen::MatrixXd spread = H * Ph * H.transpose() + (R + J * engine.process_noise * J.transpose()) / samples;
  const Eigen::MatrixXd inverse = spread.llt().solve(Eigen::MatrixXd::Identity(spread.rows(), spread.rows()));
  return detectability_bias_sigmas * engine.sensor_noise_sigma.cwiseProduct(inverse.diagonal().cwiseSqrt());
}

}  // namespace ehm::design
