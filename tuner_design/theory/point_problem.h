// SPDX-License-Identifier: Apache-2.0
#pragma once
// One operating point as a search sees it, in scaled units, with the sensors of one design. The fleet is k independent
// unknowns e of unit variance, h = Gh e, steady sensors Gy e, outputs Gz e (monitor/design/fleet_unknowns.h),
// and the objective of a linear estimate with the errors eh (of h) and ez (of z) is
//   J = wh E|eh|^2 + sum_i wz_i E ez_i^2,      wh = w_h / limit(h),  wz_i = w_z w_i / limit(z)
// so that J = w_h + w_z at the Bayes limit, if no limit vanishes. A total limit of (nearly) zero cannot divide: then
// the fleet's own spread, tr Ph or tr Hz Ph Hz^T, stands in its place, and limit_is_prior says so.

#include <string>
#include <vector>

#include "monitor/design/design.h"
#include "monitor/estimation/capacity.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::tuner_design {

using StateMatrix = estimation::BoundedMatrix<estimation::max_augmented, estimation::max_augmented>;

struct PointProblem {
  Eigen::MatrixXd A, L, C, M, F, N;   ///< discrete model; C and M with the rows of the sensors used
  Eigen::MatrixXd process_noise;      ///< Q, n x n
  Eigen::VectorXd sensor_variance;    ///< diagonal of R
  Eigen::MatrixXd health_covariance;  ///< Ph
  Eigen::MatrixXd H, Hz;              ///< steady gains of the sensors used and of the outputs
  Eigen::MatrixXd Gh, Gy, Gz;
  bool own_readout = false;          ///< the model knows its linearisation error: estimates are read off by read_out.h
  double health_weight = 0.0;        ///< wh
  Eigen::VectorXd auxiliary_weight;  ///< wz
  double health_limit = 0.0;         ///< limit(h), what w_h was divided by
  Eigen::VectorXd auxiliary_ratio;   ///< w_i / limit(z): SSEE(z) / limit(z) for w_z = 1
  double lower_bound = 0.0;          ///< J of the Bayes limits
  bool limit_is_prior = false;       ///< limit(z) or limit(h) vanished
  std::string name;                  ///< of the model
};

/// `model` discrete and scaled, `sensors` ascending indices. The limits are the Bayes limits of these very sensors.
/// @throws std::invalid_argument if a weight is negative, not finite, all are zero, or their number is wrong.
PointProblem make_point_problem(const linear_model::LinearModel& model, const estimation::SteadyGain& steady,
                                const std::vector<int>& sensors, const design::ErrorWeights& weights);

}  // namespace ehm::tuner_design
