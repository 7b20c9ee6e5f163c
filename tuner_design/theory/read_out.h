// SPDX-License-Identifier: Apache-2.0
#pragma once
// How health and outputs are read off the tuners of an engine of which the model knows that it misses something: the
// linear estimate of least error, so that Lambda counts in the gain and not only in sigma. The filter settles at
//   [x; q] = X e + noise of covariance S          X = (I - Acl)^-1 K Gy, (n+t) x k; e, Gh, Gz: design::FleetUnknowns
// and of all h = Rh q and z = F x + Rz q least squared error over the fleet and the noise have
//   Rh = Gh Xq^T Y^-1,   Rz = ((Gz - F Xx) Xq^T - F Sxq) Y^-1,   Y = Xq Xq^T + Sqq          t x t
// With as many tuners as sensors, and little noise, this is Ph H^T (H Ph H^T + Lambda)^-1 on the averaged readings, for
// whichever V: what is left is the limit of bayes_limit.h. W = V^+ in place of Rh would take what the model misses for
// health.
// Source: theory.md, section 4; own.

#include <Eigen/Cholesky>

namespace ehm::tuner_design {

/// `T`, (p+r) x (n+t), has [0; F] in its first n columns; sets the other t. Fixed capacities do not allocate.
/// @returns false if Y is not positive definite: T is as it was then.
template <class Output, class Mean, class Noise>
bool set_read_out(Output& T, const Mean& X, const Noise& S, const Eigen::MatrixXd& Gh, const Eigen::MatrixXd& Gz,
                  Eigen::Index t) {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Noise::MaxRowsAtCompileTime,
                               Noise::MaxColsAtCompileTime>;
  const Eigen::Index n = T.cols() - t, p = Gh.rows(), r = Gz.rows();
  const auto Xq = X.bottomRows(t);
  Square Y = S.bottomRightCorner(t, t);
  Y.noalias() += Xq.lazyProduct(Xq.transpose());
  const Eigen::LLT<Square> factor(Y);
  if (factor.info() != Eigen::Success) return false;
  const auto F = T.bottomLeftCorner(r, n);
  Output wanted(p + r, t);  // E[[h; z - F x] q^T]
  wanted.topRows(p).noalias() = Gh.lazyProduct(Xq.transpose());
  wanted.bottomRows(r).noalias() = Gz.lazyProduct(Xq.transpose());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Output::MaxRowsAtCompileTime, Mean::MaxColsAtCompileTime> Fx(
      r, X.cols());
  Fx.noalias() = F.lazyProduct(X.topRows(n));
  wanted.bottomRows(r).noalias() -= Fx.lazyProduct(Xq.transpose());
  wanted.bottomRows(r).noalias() -= F.lazyProduct(S.topRightCorner(n, t));
  T.rightCols(t) = factor.solve(wanted.transpose()).transpose();
  return true;
}

}  // namespace ehm::tuner_design
