// SPDX-License-Identifier: Apache-2.0
#pragma once
// One V* for several operating points, in closed form, and what it costs at each of them.
//   V* = U_t^T Ph^1/2,   U_t the t leading eigenvectors of  sum_k w_k Hk'^T (Hk' Hk'^T + Nk)^-1 Hk',  Hk' = Hk Ph^1/2
// what the points' averaged readings tell of h' = Ph^-1/2 h, so that the subspace they tell most of is kept; Nk is what a
// long average still gets wrong (lasting_noise). For one point and t = m it is H Ph, the closed form of that point.
// For t > m no steady-state filter exists (the tuners are not observable at any one point): the error is that of the
// estimate with the proper prior V Ph V^T on the tuners, which a filter with a time-varying P has:
//   E = W K,  K = C Hq^T (Hq C Hq^T + N)^-1,  Hq = H W,  C = V Ph V^T;   tr[(E H - I) Ph (E H - I)^T + E N E^T]
// Source: own derivation (theory.md, section 5). Scaled units.

#include <Eigen/Core>
#include <vector>

namespace ehm::tuner_design {

/// What the sensors of one point tell.
struct PointReadings {
  Eigen::MatrixXd H;      ///< m x p, steady
  Eigen::MatrixXd noise;  ///< N, m x m
  double weight = 1.0;
};

/// t x p, orthonormal rows. @throws std::invalid_argument if there is no point or t is not within 1 and p.
/// @throws std::runtime_error if an Hk' Hk'^T + Nk is not positive definite.
Eigen::MatrixXd shared_tuners(const std::vector<PointReadings>& points, const Eigen::VectorXd& health_sigma,
                              Eigen::Index t);

/// Squared error of health on the tuners V, with a proper prior. @throws std::runtime_error as shared_tuners.
double steady_error_on(const Eigen::MatrixXd& V, const PointReadings& point, const Eigen::VectorXd& health_sigma);

}  // namespace ehm::tuner_design
