// SPDX-License-Identifier: Apache-2.0
#pragma once
// A steady gain that holds when process noise and sensor noise are not what the model says. For the predictor
//   xhat[k+1] = A xhat[k] + A K (y[k] - C xhat[k]),   F = A (I - K C)
// the error's variance is the sum of two parts, of process noise and of sensor noise,
//   X1 = F X1 F^T + Q,   X2 = F X2 F^T + A K R (A K)^T,   V1 = tr W X1,   V2 = tr W X2
// and with both noises known up to relative uncertainties s1, s2 of their power the objective is expected error and the
// variation of it,
//   J = rho1 (V1 + V2) + rho2 (s1^2 V1^2 + s2^2 V2^2)
// Kosanam minimises it over K by a descent with differences. Its gradient, with L = F^T L F + W and c_i = rho1 + 2 rho2 s_i^2 V_i,
//   dJ/dK = -2 A^T L F X C^T + 2 c2 A^T L A K R,   X = c1 X1 + c2 X2
// vanishes where X C^T = K (C X C^T + c2 R): the equation of the Kalman filter for (c1 Q, c2 R). So the optimal robust
// gain is the Kalman gain for (Q, mu R), mu the root of one scalar equation whose right side falls with mu,
//   mu = c2 / c1
// Uncertainty by sensor: V2 = sum of V2_j, R_j scaled by mu_j = (rho1 + 2 rho2 s_j^2 V2_j)/rho1, s1 = 0: a fixed point.
// Source: S. Kosanam, thesis, Cleveland State University, ch. 4; the closed form is our own (theory.md, section 15).

#include <Eigen/Core>
#include <vector>

namespace ehm::tuner_design {

/// A n x n, C m x n, Q n x n, R m (diagonal, sensors' variances), W n x n >= 0.
struct RobustProblem {
  Eigen::MatrixXd A, C, Q, W;
  Eigen::VectorXd R;
};

struct RobustWeights {
  double rho1 = 1.0, rho2 = 1.0;  ///< of the error expected, and of its variation
  double s1 = 0.0, s2 = 0.0;      ///< relative uncertainty of the process noise, of the sensors' noise
};

struct RobustGain {
  Eigen::MatrixXd K;                   ///< n x m
  Eigen::VectorXd mu;                  ///< m, what each sensor's variance is multiplied by; all the same but by sensor
  double process = 0.0, sensor = 0.0;  ///< V1, V2
  double objective = 0.0;              ///< J
  double relative_gradient = 0.0;      ///< |dJ/dK| over the norm of its two terms, which cancel
  int riccati_equations = 0;           ///< solved
};

/// @throws std::invalid_argument if shapes do not fit, a weight or an uncertainty is negative or not finite, or rho1 is
///         not above zero. @throws estimation::SolverError if a Riccati equation has no solution.
RobustGain robust_gain(const RobustProblem& problem, const RobustWeights& weights);

/// Uncertainty of each sensor by itself, J = rho1 (V1 + V2) + rho2 sum of s_j^2 V2_j^2; s1 and s2 of `weights` are not
/// used. @throws SolverError besides if the fixed point is not found.
RobustGain robust_gain_by_sensor(const RobustProblem& problem, const RobustWeights& weights, const Eigen::VectorXd& s);

/// The Kalman gain for (Q, diag(mu) R). @throws SolverError if the Riccati equation has no solution.
Eigen::MatrixXd kalman_gain_for(const RobustProblem& problem, const Eigen::VectorXd& mu);

/// J of any stabilising gain, and its gradient. @throws SolverError if A (I - K C) is not stable.
double robust_objective(const RobustProblem& problem, const RobustWeights& weights, const Eigen::MatrixXd& K,
                        Eigen::MatrixXd* gradient = nullptr);

/// One point of the trade: the gain for (Q, mu R), and its parts of the error.
struct RobustTrade {
  double mu, process, sensor;
};

/// `count` values of mu, evenly in its logarithm from `least` to `most`: every optimum of J, whatever its weights, lies
/// on this curve.
std::vector<RobustTrade> robust_trade(const RobustProblem& problem, double least, double most, int count);

}  // namespace ehm::tuner_design
