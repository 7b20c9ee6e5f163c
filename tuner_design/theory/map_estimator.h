// SPDX-License-Identifier: Apache-2.0
#pragma once
// Maximum a posteriori estimators hhat = E y from one noisy steady snapshot, and the error of any linear one.
//   full order   E = Ph H^T (H Ph H^T + R)^-1                                             [SG] eq. 19 ff.
//   reduced      Hq = H W, Pq = V Ph V^T, E = W (Pq^-1 + Hq^T R^-1 Hq)^-1 Hq^T R^-1      [SG] eqs. 28-37
//   error        (E H - I) Ph (E H - I)^T + E R E^T; first term bias over the fleet, second variance
// H m x p, Ph p x p, R m x m, V t x p of full row rank, W = V^+ p x t, E p x m. Auxiliary outputs: Hz (error) Hz^T.

#include <Eigen/Core>

namespace ehm::tuner_design {

/// Pseudoinverse of a matrix of full row rank. @throws std::invalid_argument if V is rank deficient.
Eigen::MatrixXd right_inverse(const Eigen::MatrixXd& V);

/// @throws std::runtime_error if H Ph H^T + R is not positive definite.
Eigen::MatrixXd full_map_gain(const Eigen::MatrixXd& H, const Eigen::MatrixXd& Ph, const Eigen::MatrixXd& R);

/// @throws std::runtime_error if V Ph V^T, R or the information matrix is not positive definite.
Eigen::MatrixXd reduced_map_gain(const Eigen::MatrixXd& H, const Eigen::MatrixXd& Ph, const Eigen::MatrixXd& R,
                                 const Eigen::MatrixXd& V);

/// Error covariance of hhat = E y, p x p.
Eigen::MatrixXd snapshot_error_covariance(const Eigen::MatrixXd& E, const Eigen::MatrixXd& H, const Eigen::MatrixXd& Ph,
                                          const Eigen::MatrixXd& R);

}  // namespace ehm::tuner_design
