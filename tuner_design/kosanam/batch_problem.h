// SPDX-License-Identifier: Apache-2.0
#pragma once
// The filtering problem of Kosanam's thesis (sections 3.3 and 5.1): a linear engine at one point, its health appended
// to the state as a random walk,
//   [x; h][k+1] = [A L; 0 I] [x; h][k] + w,   y = [C M] [x; h] + v,   w ~ (0, blkdiag(Qx, qh I)),   v ~ (0, diag(R))
// sampled in short batches, one a flight: 30 samples at 10 Hz, state and covariance carried over. n + p states, m
// sensors. Scaled units (engine_sim/linear_model/scaling.h): health in percent. At m >= p the pair is detectable; the
// service's own models, with fewer sensors, are not, and are refused.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::tuner_design {

struct BatchProblem {
  std::string model;
  std::vector<std::string> health_names;
  Eigen::Index states = 0, health = 0;
  Eigen::MatrixXd A, C, Q;  ///< augmented, n + p
  Eigen::VectorXd R;
  Eigen::MatrixXd P0;  ///< where a new engine stands
  double sample_time_s = 0.0;
};

/// `health_variance`: qh, percent squared a sample. P0: every state and health parameter known to 1e-4 in the model's
/// own units, as the thesis has it.
/// @throws std::invalid_argument if there are fewer sensors than health parameters, or more than max_health of those.
BatchProblem batch_problem(const linear_model::LinearModel& model, double health_variance);

/// The same with another qh.
BatchProblem with_health_variance(BatchProblem problem, double health_variance);

/// A steady gain of it and the covariance after its update.
struct SteadyFilter {
  Eigen::MatrixXd K, P;
};

/// The steady Kalman filter. @throws estimation::SolverError if the Riccati equation has no solution.
SteadyFilter steady_filter(const BatchProblem& problem);

}  // namespace ehm::tuner_design
