// SPDX-License-Identifier: Apache-2.0
#pragma once
// The limit: no estimator that sees only steady data at one operating point has a smaller error covariance than
//   C0 = Ph - Ph H^T (H Ph H^T)^-1 H Ph          p x p
// of the health parameters, and Hz C0 Hz^T of the auxiliary outputs: endless averaging removes the noise, and the prior
// remains in the directions that H does not see. Computed as a factor, C0 = U U^T with U = L N, Ph = L L^T and N an
// orthonormal basis of what H L does not see: squared norms of its rows and of those of Hz U are the limits by channel,
// never negative, and exactly zero where H sees everything.
// Source: theory.md, section 5 (the limit of [SG] eq. 19 as R -> 0).

#include <Eigen/Core>

namespace ehm::tuner_design {

/// U, p x (p - rank H). @throws std::runtime_error if Ph is not positive definite.
Eigen::MatrixXd bayes_limit_factor(const Eigen::MatrixXd& H, const Eigen::MatrixXd& Ph);

}  // namespace ehm::tuner_design
