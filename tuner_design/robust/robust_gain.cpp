// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/robust/robust_gain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "monitor/estimation/linear/riccati.h"
#include "monitor/estimation/linear/solver_error.h"

namespace ehm::tuner_design {
namespace {

constexpr double root_is_found = 1e-14;  ///< of ln mu
constexpr int most_steps = 100;

void require(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument("robust gain: " + what);
}

void check(const RobustProblem& p, const RobustWeights& weights) {
  const Eigen::Index n = p.A.rows(), m = p.C.rows();
  require(p.A.cols() == n && p.C.cols() == n && p.Q.rows() == n && p.Q.cols() == n && p.W.rows() == n &&
              p.W.cols() == n && p.R.size() == m,
          "shapes do not fit: A " + std::to_string(n) + " x " + std::to_string(p.A.cols()) + ", C " +
              std::to_string(m) + " x " + std::to_string(p.C.cols()) + "; needed are Q and W like A, R of " +
              std::to_string(m));
  require((p.R.array() > 0.0).all(), "a sensor's variance is not above 0");
  const auto good = [](double x) { return x >= 0.0 && std::isfinite(x); };
  require(good(weights.rho1) && weights.rho1 > 0.0 && good(weights.rho2) && good(weights.s1) && good(weights.s2),
          "weights and uncertainties; allowed are finite numbers from 0 on, and rho1 above 0");
}

/// A gain, and what of the error each noise brings: V1, and V2 by sensor.
struct Parts {
  Eigen::MatrixXd K;
  double process = 0.0;
  Eigen::VectorXd sensors;
};

/// Of a gain that stabilises, by one Lyapunov equation for both: V1 = tr L Q, V2_j = r_j (A k_j)^T L (A k_j).
Parts parts_of(const RobustProblem& p, Eigen::MatrixXd K) {
  const Eigen::MatrixXd F = p.A - p.A * K * p.C;
  const Eigen::MatrixXd L = estimation::solve_discrete_lyapunov(F.transpose(), p.W);
  const Eigen::MatrixXd AK = p.A * K;
  Parts parts;
  parts.process = L.cwiseProduct(p.Q).sum();
  parts.sensors = (L * AK).cwiseProduct(AK).colwise().sum().transpose().cwiseProduct(p.R);
  parts.K = std::move(K);
  return parts;
}

Parts kalman_parts(const RobustProblem& p, const Eigen::VectorXd& mu) {
  return parts_of(p, kalman_gain_for(p, mu));
}

double slope(double rho1, double rho2, double s, double V) {
  return rho1 + 2.0 * rho2 * s * s * V;
}

/// dJ/dK where process noise counts c1 and the noise of sensor j c2_j, and the norm of its second term.
Eigen::MatrixXd gradient_of(const RobustProblem& p, const Eigen::MatrixXd& K, double c1, const Eigen::VectorXd& c2,
                            double* term) {
  const Eigen::MatrixXd F = p.A - p.A * K * p.C, AK = p.A * K;
  const Eigen::MatrixXd L = estimation::solve_discrete_lyapunov(F.transpose(), p.W);
  const Eigen::MatrixXd R = c2.cwiseProduct(p.R).asDiagonal();
  const Eigen::MatrixXd X = estimation::solve_discrete_lyapunov(F, c1 * p.Q + AK * R * AK.transpose());
  if (term != nullptr) *term = (2.0 * p.A.transpose() * L * AK * R).norm();
  return 2.0 * p.A.transpose() * L * (AK * R - F * X * p.C.transpose());
}

/// `c1`, `c2`: of the gradient at `parts`.
RobustGain finished(const RobustProblem& p, Parts parts, double c1, const Eigen::VectorXd& c2, Eigen::VectorXd mu,
                    int equations) {
  RobustGain gain;
  gain.process = parts.process;
  gain.sensor = parts.sensors.sum();
  gain.mu = std::move(mu);
  gain.riccati_equations = equations;
  double term = 0.0;
  const double norm = gradient_of(p, parts.K, c1, c2, &term).norm();
  gain.relative_gradient = term > 0.0 ? norm / term : norm;
  gain.K = std::move(parts.K);
  return gain;
}

}  // namespace

Eigen::MatrixXd kalman_gain_for(const RobustProblem& problem, const Eigen::VectorXd& mu) {
  const Eigen::MatrixXd R = mu.cwiseProduct(problem.R).asDiagonal();
  const Eigen::MatrixXd P = estimation::solve_filter_riccati(problem.A, problem.C, problem.Q, R);
  const Eigen::MatrixXd CP = problem.C * P;
  return (CP * problem.C.transpose() + R).llt().solve(CP).transpose();
}

RobustGain robust_gain(const RobustProblem& problem, const RobustWeights& weights) {
  check(problem, weights);
  const Eigen::Index m = problem.C.rows();
  int equations = 0;
  Parts parts;
  // ln mu - ln(c2/c1): rises with mu
  const auto miss = [&](double log_mu) {
    parts = kalman_parts(problem, Eigen::VectorXd::Constant(m, std::exp(log_mu)));
    ++equations;
    return log_mu - std::log(slope(weights.rho1, weights.rho2, weights.s2, parts.sensors.sum()) /
                             slope(weights.rho1, weights.rho2, weights.s1, parts.process));
  };
  // Since the right side falls, the root lies between any mu and the right side there.
  double low = 0.0, at_low = miss(low), high = -at_low;
  double at_high = at_low == 0.0 ? 0.0 : miss(high);
  double root = high;
  for (int k = 0; k < most_steps && at_high != 0.0 && std::abs(high - low) > root_is_found * (1.0 + std::abs(high));
       ++k) {
    // Illinois: a false position whose stale end counts half, so that the bracket closes from both sides.
    root = high - at_high * (high - low) / (at_high - at_low);
    const double at_root = miss(root);
    if (std::abs(at_root) <= root_is_found) break;
    if ((at_root > 0.0) != (at_high > 0.0)) {
      low = high;
      at_low = at_high;
    } else {
      at_low *= 0.5;
    }
    high = root;
    at_high = at_root;
  }
  const double c1 = slope(weights.rho1, weights.rho2, weights.s1, parts.process);
  const double c2 = slope(weights.rho1, weights.rho2, weights.s2, parts.sensors.sum());
  RobustGain gain = finished(problem, std::move(parts), c1, Eigen::VectorXd::Constant(m, c2),
                             Eigen::VectorXd::Constant(m, std::exp(root)), equations);
  gain.objective = robust_objective(problem, weights, gain.K);
  return gain;
}

RobustGain robust_gain_by_sensor(const RobustProblem& problem, const RobustWeights& weights, const Eigen::VectorXd& s) {
  check(problem, weights);
  require(s.size() == problem.C.rows() && (s.array() >= 0.0).all() && s.allFinite(),
          "one uncertainty from 0 on for each sensor is needed");
  Eigen::VectorXd log_mu = Eigen::VectorXd::Zero(s.size());
  int equations = 0;
  Parts parts;
  double change = 1.0;
  for (; change > 1e-13 && equations < most_steps; ++equations) {
    parts = kalman_parts(problem, log_mu.array().exp().matrix());
    Eigen::VectorXd next(s.size());
    for (Eigen::Index j = 0; j < s.size(); ++j)
      next(j) = std::log(slope(weights.rho1, weights.rho2, s(j), parts.sensors(j)) / weights.rho1);
    change = (next - log_mu).cwiseAbs().maxCoeff();
    log_mu = 0.5 * (log_mu + next);  // each right side falls with its mu: half a step cannot run round in a circle
  }
  if (!(change <= 1e-13))
    throw estimation::SolverError("robust gain by sensor: the factors still change by " + std::to_string(change) +
                                  " after " + std::to_string(equations) + " Riccati equations");
  const Eigen::VectorXd mu = log_mu.array().exp().matrix();
  const Eigen::VectorXd variation = s.cwiseProduct(parts.sensors);
  const double process = parts.process, sensors = parts.sensors.sum();
  RobustGain gain = finished(problem, std::move(parts), weights.rho1, weights.rho1 * mu, mu, equations);
  gain.objective = weights.rho1 * (process + sensors) + weights.rho2 * variation.squaredNorm();
  return gain;
}

double robust_objective(const RobustProblem& problem, const RobustWeights& w, const Eigen::MatrixXd& K,
                        Eigen::MatrixXd* gradient) {
  const Parts parts = parts_of(problem, K);
  const double V1 = parts.process, V2 = parts.sensors.sum();
  if (gradient != nullptr) {
    const double c2 = slope(w.rho1, w.rho2, w.s2, V2);
    *gradient =
        gradient_of(problem, K, slope(w.rho1, w.rho2, w.s1, V1), Eigen::VectorXd::Constant(K.cols(), c2), nullptr);
  }
  return w.rho1 * (V1 + V2) + w.rho2 * (w.s1 * w.s1 * V1 * V1 + w.s2 * w.s2 * V2 * V2);
}

std::vector<RobustTrade> robust_trade(const RobustProblem& problem, double least, double most, int count) {
  require(least > 0.0 && most > least && count > 1, "the trade needs 0 < least < most and two points or more");
  std::vector<RobustTrade> curve;
  for (int i = 0; i < count; ++i) {
    const double mu = least * std::pow(most / least, static_cast<double>(i) / (count - 1));
    const Parts parts = kalman_parts(problem, Eigen::VectorXd::Constant(problem.C.rows(), mu));
    curve.push_back({mu, parts.process, parts.sensors.sum()});
  }
  return curve;
}

}  // namespace ehm::tuner_design
