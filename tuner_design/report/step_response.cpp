// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/step_response.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ehm::tuner_design::report {
namespace {

Eigen::MatrixXd transition(const design::SubsetDesign& filter, const linear_model::LinearModel& model) {
  const Eigen::Index n = model.A.rows(), f = filter.A.rows(), p = model.L.cols();
  Eigen::MatrixXd Phi = Eigen::MatrixXd::Zero(n + f + p, n + f + p);
  Phi.topLeftCorner(n, n) = model.A;
  Phi.topRightCorner(n, p) = model.L;
  Phi.block(n, 0, f, n) = filter.K * model.C * model.A;
  Phi.block(n, n, f, f) = filter.A - filter.K * filter.C * filter.A;
  Phi.block(n, n + f, f, p) = filter.K * (model.C * model.L + model.M);
  Phi.bottomRightCorner(p, p).setIdentity();
  return Phi;
}

Eigen::MatrixXd power(Eigen::MatrixXd base, std::int64_t exponent) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Identity(base.rows(), base.cols());
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) result = (result * base).eval();
    base = (base * base).eval();
  }
  return result;
}

}  // namespace

StepResponse step_response(const design::SubsetDesign& filter, const linear_model::LinearModel& model, int points) {
  const Eigen::Index n = model.A.rows(), f = filter.A.rows(), p = model.L.cols(), t = filter.W.cols();
  constexpr double settled = 5.0;
  const double samples = std::max(settled * filter.slowest_time_constant_s / model.sample_time_s, 10.0);
  const auto stride = static_cast<std::int64_t>(std::max(1.0, std::ceil(samples / points)));
  const Eigen::MatrixXd Phi = power(transition(filter, model), stride);

  Eigen::MatrixXd state = Eigen::MatrixXd::Zero(n + f + p, p);
  state.bottomRows(p) = model.health_sigma.asDiagonal();
  // at the step itself: y[0] = M h, and xhat[0] = K y[0]
  state.middleRows(n, f) = filter.K * model.M * model.health_sigma.asDiagonal();
  StepResponse response;
  for (double at = 0.0; at <= samples + 0.5 * static_cast<double>(stride); at += static_cast<double>(stride)) {
    response.time_s.push_back(at * model.sample_time_s);
    response.estimate.emplace_back(filter.health_readout * state.middleRows(n + f - t, t));
    state = (Phi * state).eval();
  }
  return response;
}

}  // namespace ehm::tuner_design::report
