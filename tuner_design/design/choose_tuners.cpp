// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/design/choose_tuners.h"

#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"
#include "tuner_design/design/shared_tuners.h"
#include "tuner_design/design/tuner_baselines.h"
#include "tuner_design/search/row_space.h"

namespace ehm::tuner_design {
namespace {

/// Closed form of each point, for several points that of all first, then the SVD tuners of each.
std::vector<NamedTuners> starts_of(const Envelope& envelope, const std::vector<int>& sensors, Eigen::Index t) {
  std::vector<NamedTuners> closed, svd;
  std::vector<PointReadings> readings;
  for (std::size_t i = 0; i < envelope.points.size(); ++i) {
    const PreparedPoint& point = envelope.points[i];
    const Eigen::MatrixXd H = point.steady.H(sensors, Eigen::all);
    const std::string at = envelope.points.size() > 1 ? " at " + point.model.name : "";
    closed.push_back({"closed form H Ph" + at,
                      closed_form_tuners(H, lasting_noise(point.model, sensors), point.model.health_sigma, t)});
    readings.push_back({H, lasting_noise(point.model, sensors), envelope.weights[i]});
    svd.push_back({"SVD of [H; Hz]" + at, svd_tuners(H, point.steady.Hz, t)});
  }
  std::vector<NamedTuners> starts;
  if (envelope.points.size() > 1)
    starts.push_back(
        {"closed form of all points", shared_tuners(readings, envelope.points.front().model.health_sigma, t)});
  starts.insert(starts.end(), closed.begin(), closed.end());
  starts.insert(starts.end(), svd.begin(), svd.end());
  return starts;
}

}  // namespace

Eigen::MatrixXd lasting_noise(const linear_model::LinearModel& model, const std::vector<int>& sensors) {
  constexpr double averaging = 1.0 / 256.0;
  const Eigen::VectorXd sigma = model.sensor_noise_sigma(sensors);
  const Eigen::MatrixXd R = sigma.cwiseAbs2().asDiagonal();
  if (model.linearisation_error.size() == 0) return R;
  return model.linearisation_error(sensors, sensors) + averaging * R;
}

Eigen::MatrixXd closed_form_tuners(const Eigen::MatrixXd& H, const Eigen::MatrixXd& noise,
                                   const Eigen::VectorXd& health_sigma, Eigen::Index t) {
  if (t < 1 || t > std::min(H.rows(), H.cols())) {
    throw std::invalid_argument("closed form: " + std::to_string(t) + " tuners; allowed 1 to " +
                                std::to_string(std::min(H.rows(), H.cols())));
  }
  if (t == H.cols()) return Eigen::MatrixXd::Identity(t, t);
  const Eigen::MatrixXd Ph = health_sigma.cwiseAbs2().asDiagonal();
  if (t == H.rows()) return row_space(H * Ph);
  const Eigen::LLT<Eigen::MatrixXd> factor(noise);
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("tuners: the noise covariance N is not positive definite");
  const Eigen::MatrixXd weighted = factor.matrixL().solve(H);  // N^-1/2 H
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(weighted * health_sigma.asDiagonal(), Eigen::ComputeThinU);
  return row_space(svd.matrixU().leftCols(t).transpose() * weighted * Ph);
}

ChosenTuners choose_tuners(const Envelope& envelope, const std::vector<int>& sensors, Eigen::Index t,
                           const design::DesignOptions& options, int random_starts, unsigned threads,
                           const std::function<void(double)>& progress) {
  ChosenTuners chosen;
  chosen.problem.estimator = options.tuning == design::Tuning::map ? Estimator::map : Estimator::kalman;
  chosen.problem.qh_percent2 = options.qh_percent2;
  for (std::size_t i = 0; i < envelope.points.size(); ++i) {
    const PreparedPoint& point = envelope.points[i];
    chosen.problem.points.push_back(
        {make_point_problem(point.model, point.steady, sensors, options.weights), envelope.weights[i]});
  }
  const std::vector<NamedTuners> starts = starts_of(envelope, sensors, t);
  if (options.tuning == design::Tuning::closed_form || t == envelope.points.front().model.L.cols() ||
      read_off(chosen.problem)) {
    chosen.search.V = starts.front().V;
    return chosen;
  }
  chosen.closed_form = objective(chosen.problem, starts.front().V);
  chosen.search = search_tuners(chosen.problem, {starts, random_starts, options.seed, threads, progress});
  return chosen;
}

}  // namespace ehm::tuner_design
