// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/monte_carlo/finite_window.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "engine_sim/linear_model/discretise.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::tuner_design {
namespace {

using design::ErrorByChannel;

constexpr double most_samples = 1e6;  ///< of a run: the published intervals of the window are kept

/// What reads an error out of the estimate for the health parameters or the auxiliary outputs.
struct Output {
  Eigen::MatrixXd of_estimate;     ///< T
  Eigen::MatrixXd truth;           ///< I or Hz
  Eigen::MatrixXd of_truth_error;  ///< e, rows x r
};

/// Filter and engine of the linear theory, scaled.
struct Loop {
  linear_model::LinearModel model;
  estimation::SteadyGain steady;
  Eigen::MatrixXd K, closed_loop, start, noise;  ///< S before the first sample; what each sample adds to S
  Output health, auxiliary;
};

Eigen::MatrixXd seen_through(const Eigen::MatrixXd& T, const Eigen::MatrixXd& covariance) {
  return T * covariance * T.transpose();
}

Loop loop_of(const design::Design& design, bool process_noise) {
  Loop loop;
  loop.model = linear_model::scaled(discretise(design.model), design.scaling);
  loop.steady = estimation::steady_gain(loop.model);
  const linear_model::LinearModel& model = loop.model;
  const design::SubsetDesign& filter = design.full;
  const Eigen::Index n = model.A.rows(), p = model.L.cols(), r = model.F.rows(), t = filter.V.rows(), a = n + t;
  loop.K = filter.K;
  loop.closed_loop = filter.A - filter.K * filter.C * filter.A;
  loop.noise = seen_through(filter.K, model.sensor_noise_sigma.cwiseAbs2().asDiagonal());
  loop.start.setZero(a, a);
  if (process_noise) {
    const Eigen::MatrixXd I_KC = Eigen::MatrixXd::Identity(a, a) - filter.K * filter.C;
    loop.noise += seen_through(I_KC.leftCols(n), model.process_noise);
    loop.start.topLeftCorner(n, n) = linear_model::stationary_covariance(model.A, model.process_noise);
  }

  loop.health.of_estimate.setZero(p, a);  // Th = [0, Rh]
  loop.health.of_estimate.rightCols(t) = filter.health_readout;
  loop.health.truth.setIdentity(p, p);
  loop.health.of_truth_error.setZero(p, r);
  loop.auxiliary.of_estimate.resize(r, a);  // Tz = [F, Rz]
  loop.auxiliary.of_estimate << model.F, filter.auxiliary_readout;
  loop.auxiliary.truth = loop.steady.Hz;
  loop.auxiliary.of_truth_error.setIdentity(r, r);
  return loop;
}

/// Variances of the rows of T X for a covariance X.
Eigen::VectorXd variances(const Eigen::MatrixXd& T, const Eigen::MatrixXd& covariance) {
  return (T * covariance).cwiseProduct(T).rowwise().sum();
}

Eigen::VectorXd linear_error(const Output& output, const Loop& loop, const Eigen::MatrixXd& mean,
                             const Eigen::MatrixXd& spread) {
  const Eigen::MatrixXd bias = (output.of_estimate * mean - output.truth) * loop.model.health_sigma.asDiagonal();
  return bias.rowwise().squaredNorm() + variances(output.of_estimate, spread);
}

Eigen::VectorXd linearisation_part(const Output& output, const Loop& loop, const Eigen::MatrixXd& offset) {
  if (loop.model.linearisation_error.size() == 0) return Eigen::VectorXd::Zero(output.truth.rows());
  Eigen::MatrixXd response(output.truth.rows(), loop.model.linearisation_error.rows());
  response << output.of_estimate * offset, -output.of_truth_error;
  return variances(response, loop.model.linearisation_error);
}

ErrorByChannel zero_error(const Loop& loop) {
  return {Eigen::VectorXd::Zero(loop.model.L.cols()), Eigen::VectorXd::Zero(loop.model.F.rows())};
}

}  // namespace

Window window_of(double seconds, double window_s, double sample_time_s) {
  const double samples = std::round(seconds / sample_time_s), averaged = std::round(window_s / sample_time_s);
  if (averaged >= 1.0 && averaged <= samples && samples <= most_samples)
    return {static_cast<int>(samples), static_cast<int>(averaged)};
  std::ostringstream message;
  message << "a window of " << window_s << " s at the end of a run of " << seconds
          << " s; allowed: windows of one sample (" << sample_time_s << " s) to the whole run, runs of at most "
          << most_samples * sample_time_s << " s";
  throw std::invalid_argument(message.str());
}

WindowError finite_window_error(const design::Design& design, const Window& window, bool process_noise) {
  const Loop loop = loop_of(design, process_noise);
  const Eigen::MatrixXd KH = loop.K * loop.steady.H;
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(KH.rows(), KH.cols());
  Eigen::MatrixXd offset = Eigen::MatrixXd::Zero(loop.K.rows(), loop.K.cols()), spread = loop.start;
  WindowError error{zero_error(loop), zero_error(loop)};
  for (int k = 0; k < window.samples; ++k) {
    mean = loop.closed_loop * mean + KH;
    offset = loop.closed_loop * offset + loop.K;
    spread = seen_through(loop.closed_loop, spread) + loop.noise;
    if (k < window.first()) continue;
    error.linear.health += linear_error(loop.health, loop, mean, spread);
    error.linear.auxiliary += linear_error(loop.auxiliary, loop, mean, spread);
    error.linearisation.health += linearisation_part(loop.health, loop, offset);
    error.linearisation.auxiliary += linearisation_part(loop.auxiliary, loop, offset);
  }
  for (ErrorByChannel* part : {&error.linear, &error.linearisation}) {
    part->health /= window.averaged;
    part->auxiliary /= window.averaged;
  }
  return error;
}

ErrorByChannel settled_error(const design::Design& design, bool process_noise) {
  if (process_noise) return design.ssee;
  const Loop loop = loop_of(design, false);
  const Eigen::MatrixXd spread = estimation::solve_discrete_lyapunov(loop.closed_loop, loop.noise);
  const auto without = [&](const Eigen::VectorXd& with, const Eigen::MatrixXd& noise, const Output& output) {
    return Eigen::VectorXd(with - noise.diagonal() + variances(output.of_estimate, spread));
  };
  return {without(design.ssee.health, design.full.health_noise_covariance, loop.health),
          without(design.ssee.auxiliary, design.full.auxiliary_noise_covariance, loop.auxiliary)};
}

}  // namespace ehm::tuner_design
