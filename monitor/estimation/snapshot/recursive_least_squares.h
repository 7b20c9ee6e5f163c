// SPDX-License-Identifier: Apache-2.0
#pragma once
// Recursive least squares over snapshots e = Hn h + ... + v (snapshot_model.h; h in sigmas of the fleet, so that its
// prior is N(0, I)), with exponential forgetting towards the prior. It is the minimum of
//
//   h^T h + sum over samples i and their sensors of lambda^(k-i) (e_i - Hn h)^2,    0 < lambda <= 1
//
//   start    hhat = 0,  P = I
//   forget   T = (lambda I + (1 - lambda) P)^-1:   hhat <- lambda T hhat,   P <- T P
//   update   for each fused sensor i, c = Hn_i:    s = c P c^T + 1,  b = P c^T / sqrt(s)
//            hhat <- hhat + b (e_i - c hhat) / sqrt(s),   P <- P - b b^T
//
// **No wind-up.** P/lambda, the usual form, lets P grow without bound where nothing is seen: the information falls as
// lambda^k. Here what falls is only the information of the readings; the prior's stays,
// P^-1 <- lambda P^-1 + (1 - lambda) I, so that P never exceeds I. This is stabilised forgetting, the weighted geometric mean of the posterior and
// the prior (Kulhavy & Zarrop, Int. J. of Control 58 (1993) 905). What no sensor sees stays at the prior, what they see
// is averaged over 1/(1 - lambda) samples. lambda = 1 is recursive Bayes: no linear estimator knows more of a constant
// h of an engine in balance. P commutes with T, has eigenvalues from 0 to 1, and is symmetric to the last bit.
//
// **Its error.** P counts sensor noise as white and nothing else: the engine's own motion, which lasts, and what the
// linear model misses are not in it. They are carried along (snapshot_error.h), with c, b for the last sensor:
//
//   forget   Bh = -P;   Bo <- lambda T Bo;   Sx <- lambda A Sx T;   S <- lambda^2 T S T
//   update   g = b/sqrt(s), eta = Cn_i dx + v_i - c eps:   Bo += g (En_i - c Bo);   Sx += cov(dx, eta) g^T;
//            S += cov(eps, eta) g^T + g cov(eps, eta)^T + var(eta) g g^T
//
// Source: Plackett, Biometrika 37 (1950) 149 (recursion); Bierman (1977), ch. II (scalar processing); Endurthi's
// thesis, section 3.1.4. Real-time safe: yes, all but construction and fresh().

#include "monitor/estimation/snapshot/snapshot_method.h"

namespace ehm::estimation {

class RecursiveLeastSquares final : public SnapshotMethod {
 public:
  /// `kept` is lambda. @throws std::invalid_argument if it is not above 0 and at most 1.
  RecursiveLeastSquares(std::shared_ptr<const SnapshotModel> model, double kept);

  [[nodiscard]] std::unique_ptr<SnapshotMethod> fresh() const override;
  void reset() noexcept override;
  /// Forgets by lambda^samples at once, which is the same as one after the other.
  void pass(int samples) noexcept override;
  bool update(const SensorVector& readings, SensorMask fused) noexcept override;
  /// P is -Bh, and must be a covariance.
  bool restore(const HealthVector& health, const SnapshotError& error) noexcept override;
  bool correct(const HealthVector& health) noexcept override;
  [[nodiscard]] const HealthVector& health() const noexcept override { return health_; }
  [[nodiscard]] const SnapshotError& error() const noexcept override { return error_; }
  /// P
  [[nodiscard]] HealthCovariance own_covariance() const noexcept override { return -error_.health_bias; }

 private:
  void forget(double kept) noexcept;
  void fuse(Eigen::Index sensor, double reading) noexcept;

  std::shared_ptr<const SnapshotModel> model_;
  double kept_;
  HealthVector health_;  ///< hhat
  SnapshotError error_;
};

}  // namespace ehm::estimation
