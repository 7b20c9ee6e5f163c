// SPDX-License-Identifier: Apache-2.0
#include "monitor/nonlinear/sigma_points.h"

#include <cmath>
#include <stdexcept>

namespace ehm::nonlinear {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("sigma points: ") + what);
}

SigmaPoints symmetric(Eigen::Index d, double kappa) {
  const double n = static_cast<double>(d) + kappa;
  require(n > 0.0, "d + kappa must be above 0");
  SigmaPoints set;
  set.points.setZero(d, 2 * d + 1);
  set.points.middleCols(1, d).diagonal().setConstant(std::sqrt(n));
  set.points.rightCols(d).diagonal().setConstant(-std::sqrt(n));
  set.mean_weights.setConstant(2 * d + 1, 0.5 / n);
  set.mean_weights(0) = kappa / n;
  return set;
}

/// Dimension j = 1..d: `before` to all points until then, and `own` to the new one.
template <class Before, class Own>
Eigen::MatrixXd simplex(Eigen::Index d, const Before& before, const Own& own) {
  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(d, d + 2);
  for (Eigen::Index j = 1; j <= d; ++j) {
    points.row(j - 1).segment(1, j).setConstant(-before(j));
    points(j - 1, j + 1) = own(j);
  }
  return points;
}

SigmaPoints spherical_simplex(Eigen::Index d, double w0) {
  const double w1 = (1.0 - w0) / static_cast<double>(d + 1);
  const auto root = [&](Eigen::Index j) { return std::sqrt(static_cast<double>(j * (j + 1)) * w1); };
  SigmaPoints set;
  set.points = simplex(
      d, [&](Eigen::Index j) { return 1.0 / root(j); },
      [&](Eigen::Index j) { return static_cast<double>(j) / root(j); });
  set.mean_weights.setConstant(d + 2, w1);
  set.mean_weights(0) = w0;
  return set;
}

SigmaPoints minimal_skew(Eigen::Index d, double w0) {
  SigmaPoints set;
  set.mean_weights.resize(d + 2);
  set.mean_weights(0) = w0;
  for (Eigen::Index i = 1; i < d + 2; ++i)
    set.mean_weights(i) = std::ldexp(1.0 - w0, static_cast<int>((i < 2 ? 0 : i - 2) - d));
  const auto far = [&](Eigen::Index j) { return 1.0 / std::sqrt(2.0 * set.mean_weights(j + 1)); };
  set.points = simplex(d, far, far);
  return set;
}

SigmaPoints unscaled(Eigen::Index d, const SigmaOptions& options) {
  switch (options.set) {
    case SigmaSet::symmetric:
      return symmetric(d, options.kappa);
    case SigmaSet::spherical_simplex:
      return spherical_simplex(d, options.centre_weight);
    case SigmaSet::minimal_skew:
      return minimal_skew(d, options.centre_weight);
  }
  throw std::invalid_argument("sigma points: no such set");
}

}  // namespace

SigmaPoints sigma_points(Eigen::Index dimension, const SigmaOptions& options) {
  require(dimension >= 1, "at least one dimension");
  require(options.centre_weight >= 0.0 && options.centre_weight < 1.0, "the centre's weight is from 0 to below 1");
  require(options.alpha >= 0.0, "alpha must not be below 0");
  SigmaPoints set = unscaled(dimension, options);
  const double farthest = set.points.colwise().norm().maxCoeff();
  const double a = options.alpha > 0.0 ? options.alpha : std::sqrt(3.0) / farthest, a2 = a * a;
  set.points *= a;
  set.mean_weights /= a2;
  set.mean_weights(0) += 1.0 - 1.0 / a2;
  set.covariance_weights = set.mean_weights;
  set.covariance_weights(0) += 1.0 - a2 + options.beta;
  return set;
}

}  // namespace ehm::nonlinear
