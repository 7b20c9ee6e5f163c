// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/robust/robust_study.h"

#include <cmath>
#include <numeric>

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/design/tuner_number.h"
#include "tuner_design/theory/kalman_gain.h"

namespace ehm::tuner_design {
namespace {

constexpr double most_mu = 1e6;
constexpr int halvings = 60;

/// The filter's problem, and how health is read off its states.
struct Filter {
  RobustProblem problem;
  Eigen::MatrixXd health;  ///< [0, W], p x (n+t)
};

Filter filter_of(const PreparedPoint& point, double qh_percent2) {
  const std::vector<int> all = all_sensors(point.model);
  const std::vector<int> seeing = seeing_sensors({point}, all);
  const Eigen::Index t = most_tuners(point, seeing, qh_percent2), n = point.model.A.rows();
  const Eigen::MatrixXd V = closed_form_tuners(point.steady.H(seeing, Eigen::all), lasting_noise(point.model, seeing),
                                               point.model.health_sigma, t);
  const design::SubsetDesign design = kalman_gain(point.model, seeing, V, qh_percent2);
  Filter filter;
  filter.health.setZero(design.W.rows(), n + t);
  filter.health.rightCols(t) = design.W;
  RobustProblem& p = filter.problem;
  p.A = design.A;
  p.C = design.C(seeing, Eigen::all);
  p.Q.setZero(n + t, n + t);
  p.Q.topLeftCorner(n, n) = point.model.process_noise;
  p.Q.bottomRightCorner(t, t) = qh_percent2 * V * V.transpose();
  p.W = filter.health.transpose() * filter.health;
  p.R = point.model.sensor_noise_sigma(seeing).cwiseAbs2();
  return filter;
}

/// Of a gain under sensors' noise that may be another than the model's.
HealthErrors errors_of(const Filter& filter, const Eigen::MatrixXd& K, const Eigen::VectorXd& R) {
  const RobustProblem& p = filter.problem;
  const Eigen::MatrixXd I_KC = Eigen::MatrixXd::Identity(p.A.rows(), p.A.cols()) - K * p.C, F = p.A * I_KC;
  const Eigen::MatrixXd KRK = K * R.asDiagonal() * K.transpose();
  const Eigen::MatrixXd X = estimation::solve_discrete_lyapunov(F, p.Q + p.A * KRK * p.A.transpose());
  const Eigen::MatrixXd updated = filter.health * (I_KC * X * I_KC.transpose() + KRK) * filter.health.transpose();
  HealthErrors errors;
  for (Eigen::Index i = 0; i < updated.rows(); ++i) errors.push_back(std::sqrt(updated(i, i)));
  errors.push_back(std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size()));
  return errors;
}

/// Largest mu, in the directions of `doubted`, whose gain costs no more than the loss where nothing is wrong.
Eigen::VectorXd dearest(const Filter& filter, const Eigen::VectorXd& doubted, double most_error) {
  const auto mu_at = [&](double log_mu) { return Eigen::VectorXd((log_mu * doubted.array()).exp().matrix()); };
  double low = 0.0, high = std::log(most_mu);
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    const bool dear =
        errors_of(filter, kalman_gain_for(filter.problem, mu_at(middle)), filter.problem.R).back() > most_error;
    (dear ? high : low) = middle;
  }
  return mu_at(low);
}

/// V2 by sensor of the Kalman gain for (Q, diag(mu) R).
Eigen::VectorXd noise_parts(const RobustProblem& p, const Eigen::VectorXd& mu) {
  const Eigen::MatrixXd K = kalman_gain_for(p, mu);
  RobustProblem alone = p;
  alone.Q.setZero();
  Eigen::VectorXd parts(p.R.size());
  for (Eigen::Index j = 0; j < parts.size(); ++j) {
    alone.R.setZero();
    alone.R(j) = p.R(j);
    parts(j) = robust_objective(alone, {1.0, 0.0, 0.0, 0.0}, K);
  }
  return parts;
}

/// rho2 s2^2/rho1 of which a common mu is the optimum: mu = 1 + 2 rho2 s2^2 V2.
double doubt_of_all(const RobustProblem& p, double mu) {
  return (mu - 1.0) / (2.0 * noise_parts(p, Eigen::VectorXd::Constant(p.R.size(), mu)).sum());
}

/// rho2 s_j^2/rho1 by sensor: mu_j = 1 + 2 rho2 s_j^2 V2_j.
Eigen::VectorXd doubt_of_each(const RobustProblem& p, const Eigen::VectorXd& mu) {
  return (mu.array() - 1.0).matrix().cwiseQuotient(2.0 * noise_parts(p, mu));
}

}  // namespace

RobustStudy run_robust_study(const linear_model::LinearModel& model, const RobustStudyOptions& options) {
  const PreparedPoint point = prepare(model);
  const Filter filter = filter_of(point, options.qh_percent2);
  const RobustProblem& p = filter.problem;
  const Eigen::VectorXd everyone = Eigen::VectorXd::Ones(p.R.size());
  RobustStudy study;
  study.options = options;
  study.model = model.name;
  study.health = names_of(model.health);
  study.tuners = p.A.rows() - point.model.A.rows();

  const Eigen::MatrixXd standard = kalman_gain_for(p, everyone);
  study.standard = errors_of(filter, standard, p.R);
  const double most_error = (1.0 + options.nominal_loss) * study.standard.back();
  study.mu = dearest(filter, everyone, most_error)(0);
  study.rho2_s2 = doubt_of_all(p, study.mu);
  const Eigen::MatrixXd robust = robust_gain(p, {1.0, study.rho2_s2, 0.0, 1.0}).K;
  study.robust = errors_of(filter, robust, p.R);
  study.standard_wrong = errors_of(filter, standard, options.noise_factor * p.R);
  study.robust_wrong = errors_of(filter, robust, options.noise_factor * p.R);

  const std::vector<int> seeing = seeing_sensors({point}, all_sensors(model));
  for (Eigen::Index j = 0; j < p.R.size(); ++j) {
    const Eigen::VectorXd doubted = Eigen::VectorXd::Unit(p.R.size(), j);
    Eigen::VectorXd R = p.R;
    R(j) *= options.noise_factor;
    const Eigen::VectorXd own_mu = dearest(filter, doubted, most_error);
    const Eigen::VectorXd s = doubt_of_each(p, own_mu).cwiseSqrt();
    const Eigen::MatrixXd own = robust_gain_by_sensor(p, {1.0, 1.0, 0.0, 0.0}, s).K;
    study.by_sensor.push_back({model.sensors[static_cast<std::size_t>(seeing[static_cast<std::size_t>(j)])].name,
                               errors_of(filter, standard, R).back(), errors_of(filter, robust, R).back(),
                               errors_of(filter, own, R).back()});
  }
  study.trade = robust_trade(p, 0.01, 1e4, 100);
  return study;
}

}  // namespace ehm::tuner_design
