// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/identify/nonnegative_fit.h"

#include <algorithm>
#include <vector>

#include "deploy/runtime/numbers/decompositions.h"

namespace ehm::tuner_design {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double ridge = 1e-12, flat = 1e-10;

/// F x = b over the free ones, the others 0.
VectorXd solved_for(const std::vector<Index>& free, const MatrixXd& F, const VectorXd& b) {
  VectorXd x = VectorXd::Zero(b.size());
  const MatrixXd part = F(free, free);
  const VectorXd right = b(free);
  x(free) = part.ldlt().solve(right).eval();
  return x;
}

/// The share of the way from x to `target` that keeps all free ones at 0 or above.
double longest_step(const std::vector<Index>& free, const VectorXd& x, const VectorXd& target) {
  double share = 1.0;
  for (const Index i : free)
    if (target(i) <= 0.0) share = std::min(share, x(i) / (x(i) - target(i)));
  return share;
}

}  // namespace

VectorXd nonnegative_fit(const MatrixXd& F, const VectorXd& b) {
  const Index k = b.size();
  const VectorXd scale = F.diagonal().cwiseSqrt().cwiseInverse();
  MatrixXd scaled = scale.asDiagonal() * F * scale.asDiagonal();
  scaled.diagonal().array() += ridge;
  const VectorXd right = scale.cwiseProduct(b);
  VectorXd x = VectorXd::Zero(k);
  std::vector<Index> free;
  for (Index turn = 0; turn < 10 * k; ++turn) {
    VectorXd slope = right - scaled * x;
    for (const Index i : free) slope(i) = 0.0;
    Index steepest = 0;
    if (slope.maxCoeff(&steepest) <= flat * right.cwiseAbs().maxCoeff()) break;
    free.push_back(steepest);
    VectorXd target = solved_for(free, scaled, right);
    while (!free.empty() && target(free).minCoeff() <= 0.0) {
      x += longest_step(free, x, target) * (target - x);
      std::erase_if(free, [&](Index i) { return target(i) <= 0.0 && x(i) <= 1e-14 * std::max(1.0, x.maxCoeff()); });
      for (Index i = 0; i < k; ++i)
        if (std::find(free.begin(), free.end(), i) == free.end()) x(i) = 0.0;
      target = free.empty() ? VectorXd::Zero(k) : solved_for(free, scaled, right);
    }
    x = target;
  }
  return scale.cwiseProduct(x);
}

}  // namespace ehm::tuner_design
