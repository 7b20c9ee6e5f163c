// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/kosanam/batch_filter.h"

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/estimation/constrained/truncated_gaussian.h"

namespace ehm::tuner_design {

using estimation::HealthCovariance;
using estimation::HealthVector;

void TimeVaryingGain::step() {
  const Eigen::MatrixXd& C = problem_.C;
  const Eigen::MatrixXd P = problem_.A * now_.P * problem_.A.transpose() + problem_.Q;
  const Eigen::MatrixXd CP = C * P;
  Eigen::MatrixXd S = CP * C.transpose();
  S.diagonal() += problem_.R;
  now_.K = S.llt().solve(CP).transpose();
  const Eigen::MatrixXd updated = P - now_.K * CP;
  now_.P = 0.5 * (updated + updated.transpose());
}

BatchFilter::BatchFilter(const BatchProblem& problem, const FilterCase& what, const Eigen::VectorXd& direction)
    : problem_(problem),
      case_(what),
      constraint_(direction),
      estimate_(Eigen::VectorXd::Zero(problem.A.rows())),
      health_(HealthVector::Zero(problem.health)),
      sigma_(health_) {
  constraint_.take(health_);
}

void BatchFilter::take(const Eigen::VectorXd& y, const SteadyFilter& gain) {
  const Eigen::VectorXd predicted = problem_.A * estimate_;
  estimate_ = predicted + gain.K * (y - problem_.C * predicted);
  health_ = estimate_.tail(problem_.health);
  sigma_ = gain.P.diagonal().tail(problem_.health).cwiseSqrt();
  if (case_.way == BatchWay::none) return;
  const HealthVector margin = case_.margin_sigma * sigma_;
  constrain(gain);
  constraint_.take(health_ - constraint_.direction().cwiseProduct(margin));
}

void BatchFilter::constrain(const SteadyFilter& gain) {
  const HealthVector &lower = constraint_.lower(), &upper = constraint_.upper();
  HealthCovariance P = gain.P.bottomRightCorner(problem_.health, problem_.health);
  if (case_.way == BatchWay::projection) estimation::project_onto_box(P, lower, upper, health_);
  if (case_.way == BatchWay::truncation && estimation::truncate_to_box(lower, upper, health_, P))
    sigma_ = P.diagonal().cwiseSqrt();
  health_ = estimation::clamped_to_box(health_, lower, upper);
  if (case_.feeds_back && health_ != estimate_.tail(problem_.health)) feed_back(gain);
}

void BatchFilter::feed_back(const SteadyFilter& gain) {
  const Eigen::Index p = problem_.health;
  if (case_.way != BatchWay::identity) {
    const Eigen::MatrixXd Phh = gain.P.bottomRightCorner(p, p);
    const Eigen::VectorXd change = health_ - estimate_.tail(p);
    estimate_.head(problem_.states) += gain.P.topRightCorner(problem_.states, p) * Phh.llt().solve(change);
  }
  estimate_.tail(p) = health_;
}

}  // namespace ehm::tuner_design
