#pragma once
// One operating point as a search sees it, in scaled units, with the sensors of one design. The fleet is k independent
// unknowns e of unit variance: health, and what the engine's nonlinearity adds (error_propagation.h). With them
//   h = Gh e  (p x k)      steady sensors Gy e  (m x k)      outputs Gz e  (r x k)
// and the objective of a linear estimate with the errors eh (of h) and ez (of z) is
//   J = wh E|eh|^2 + sum_i wz_i E ez_i^2,      wh = w_h / limit(h),  wz_i = w_z w_i / limit(z)
// so that J = w_h + w_z at the Bayes limit, which is reached only where limit(z) > 0. A total limit of (nearly) zero
// cannot divide: then what the fleet itself would give, tr Hz Ph Hz^T, stands in its place, and limit_is_prior says so.

#include <vector>

#include "monitor/estimation/capacity.h"
#include "monitor/estimation/linear_model.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::bench {

/// What a design is to be good at.
struct ErrorWeights {
  double health = 1.0;      ///< w_h
  double auxiliary = 1.0;   ///< w_z
  Eigen::VectorXd channel;  ///< w_i of each auxiliary output; empty: 1 each
};

using StateMatrix = estimation::BoundedMatrix<estimation::max_augmented, estimation::max_augmented>;

struct PointProblem {
  Eigen::MatrixXd A, L, C, M, F, N;   ///< discrete model; C and M with the rows of the sensors used
  Eigen::MatrixXd process_noise;      ///< Q, n x n
  Eigen::VectorXd sensor_variance;    ///< diagonal of R
  Eigen::MatrixXd health_covariance;  ///< Ph
  Eigen::MatrixXd H, Hz;              ///< steady gains of the sensors used and of the outputs
  Eigen::MatrixXd Gh, Gy, Gz;
  double health_weight = 0.0;        ///< wh
  Eigen::VectorXd auxiliary_weight;  ///< wz
  double health_limit = 0.0;         ///< what w_h was divided by
  double auxiliary_limit = 0.0;      ///< what w_z was divided by; channel weights included
  bool limit_is_prior = false;       ///< the auxiliary limit vanished
};

/// `model` discrete and scaled, `sensors` ascending indices. The limits are the Bayes limits of these very sensors.
/// @throws std::invalid_argument if a weight is negative, not finite, all are zero, or their number is wrong.
PointProblem make_point_problem(const estimation::LinearModel& model, const estimation::SteadyGain& steady,
                                const std::vector<int>& sensors, const ErrorWeights& weights);

}  // namespace ehm::bench
