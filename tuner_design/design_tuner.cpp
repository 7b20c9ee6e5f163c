#include "tuner_design/design_tuner.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "tuner_design/bayes_limit.h"
#include "tuner_design/discretise.h"
#include "tuner_design/kalman_error.h"
#include "tuner_design/kalman_gain.h"
#include "tuner_design/map_estimator.h"
#include "tuner_design/observability.h"

namespace ehm::bench {
namespace {

using design::Design;
using design::ErrorByChannel;
using design::SubsetDesign;
using estimation::LinearModel;
using estimation::SteadyGain;

Observability observability_of(const LinearModel& model, const Eigen::MatrixXd& H, const std::vector<int>& sensors) {
  LinearModel part;
  part.health = model.health;
  part.health_sigma = model.health_sigma;
  part.sensor_noise_sigma = model.sensor_noise_sigma(sensors);
  for (const int sensor : sensors) part.sensors.push_back(model.sensors[static_cast<std::size_t>(sensor)]);
  return steady_observability(part, H(sensors, Eigen::all));
}

/// N: what a long average of these sensors still gets wrong.
Eigen::MatrixXd lasting_noise(const LinearModel& model, const std::vector<int>& sensors) {
  constexpr double averaging = 1.0 / 256.0;
  const Eigen::VectorXd sigma = model.sensor_noise_sigma(sensors);
  const Eigen::MatrixXd R = sigma.cwiseAbs2().asDiagonal();
  if (model.linearisation_error.size() == 0) return R;
  return model.linearisation_error(sensors, sensors) + averaging * R;
}

SubsetDesign design_subset(const LinearModel& model, const SteadyGain& steady, const std::vector<int>& sensors,
                           Eigen::Index tuners, double qh_percent2) {
  const Eigen::MatrixXd V =
      closed_form_tuners(steady.H(sensors, Eigen::all), lasting_noise(model, sensors), model.health_sigma, tuners);
  SubsetDesign design = kalman_gain(model, sensors, V, qh_percent2);
  add_error_theory(design, model, steady);
  return design;
}

bool within_prior(const SubsetDesign& design, const LinearModel& scaled_model) {
  return (design.health_total_covariance.diagonal().array() <= scaled_model.health_sigma.array().square()).all();
}

/// On as many tuners as leave every sigma within the prior; none if that is not possible.
std::optional<SubsetDesign> design_within_prior(const LinearModel& model, const SteadyGain& steady,
                                                const std::vector<int>& sensors, double qh_percent2) {
  for (Eigen::Index t = observability_of(model, steady.H, sensors).rank; t >= 1; --t) {
    SubsetDesign design = design_subset(model, steady, sensors, t, qh_percent2);
    if (within_prior(design, model)) return design;
  }
  return std::nullopt;
}

std::optional<SubsetDesign> design_without(int absent, const LinearModel& model, const SteadyGain& steady,
                                           double qh_percent2) {
  std::vector<int> present;
  for (int i = 0; i < static_cast<int>(model.sensors.size()); ++i) {
    if (i != absent) present.push_back(i);
  }
  if (present.empty()) return std::nullopt;
  auto design = design_within_prior(model, steady, present, qh_percent2);
  if (design || model.linearisation_error.size() == 0) return design;
  // A model that misses so much of its engine has no such design; the least bad one still tells its true sigma.
  for (Eigen::Index t = observability_of(model, steady.H, present).rank; t >= 1; --t) {
    SubsetDesign candidate = design_subset(model, steady, present, t, qh_percent2);
    if (!design || candidate.health_total_covariance.trace() < design->health_total_covariance.trace())
      design = std::move(candidate);
  }
  return design;
}

/// All sensors, on as many tuners as sensors; fewer where the model's linearisation error asks for it.
SubsetDesign design_full(const LinearModel& model, const SteadyGain& steady, const std::vector<int>& all,
                         double qh_percent2) {
  if (model.linearisation_error.size() > 0) {
    if (auto design = design_within_prior(model, steady, all, qh_percent2)) return *design;
  }
  const auto tuners = static_cast<Eigen::Index>(std::min(all.size(), model.health.size()));
  return design_subset(model, steady, all, tuners, qh_percent2);
}

/// Variances of health and of the auxiliary outputs for an error covariance of health.
ErrorByChannel by_channel(const Eigen::MatrixXd& health_covariance, const Eigen::MatrixXd& Hz) {
  return {health_covariance.diagonal(), (Hz * health_covariance * Hz.transpose()).diagonal()};
}

void add_errors_and_limits(Design& design, const LinearModel& model, const SteadyGain& steady) {
  const Eigen::MatrixXd Ph = model.health_sigma.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd R = model.sensor_noise_sigma.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd full = full_map_gain(steady.H, Ph, R);
  const Eigen::MatrixXd U = bayes_limit_factor(steady.H, Ph);
  const Eigen::MatrixXd reduced = reduced_map_gain(steady.H, Ph, R, design.full.V);
  design.linearisation = {design.full.health_linearisation_covariance.diagonal(),
                          design.full.auxiliary_linearisation_covariance.diagonal()};
  design.ssee = {design.full.health_total_covariance.diagonal() - design.linearisation.health,
                 design.full.auxiliary_total_covariance.diagonal() - design.linearisation.auxiliary};
  design.bayes_limit = {U.rowwise().squaredNorm(), (steady.Hz * U).rowwise().squaredNorm()};
  design.full_map = by_channel(snapshot_error_covariance(full, steady.H, Ph, R), steady.Hz);
  design.reduced_map = by_channel(snapshot_error_covariance(reduced, steady.H, Ph, R), steady.Hz);
}

}  // namespace

Eigen::MatrixXd row_space(const Eigen::MatrixXd& V) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(V.transpose());
  Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(V.cols(), V.rows());
  for (Eigen::Index i = 0; i < V.rows(); ++i) {
    if (qr.matrixQR()(i, i) < 0.0) basis.col(i) = -basis.col(i);
  }
  return basis.transpose();
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

std::vector<std::string> worse_than_prior(const SubsetDesign& design, const LinearModel& model,
                                          const estimation::Scaling& scaling) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.health.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double prior = model.health_sigma(at) / scaling.health(at);
    if (design.health_total_covariance(at, at) > prior * prior) names.push_back(model.health[i].name);
  }
  return names;
}

Design design_tuner(const LinearModel& model, const design::DesignOptions& options) {
  if (!(options.qh_percent2 > 0.0) || !std::isfinite(options.qh_percent2)) {
    throw std::invalid_argument("qh is " + std::to_string(options.qh_percent2) +
                                "; allowed: above 0 percent^2 per sample (without it the filter stops listening)");
  }
  Design design;
  design.model = model;
  design.options = options;
  design.scaling = estimation::scaling_of(model);
  const LinearModel discrete = estimation::scaled(discretise(model), design.scaling);
  const SteadyGain steady = estimation::steady_gain(discrete);

  std::vector<int> all(model.sensors.size());
  std::iota(all.begin(), all.end(), 0);
  require_observable(observability_of(discrete, steady.H, all), all.size() < model.health.size());
  design.full = design_full(discrete, steady, all, options.qh_percent2);
  add_errors_and_limits(design, discrete, steady);
  for (const int absent : all) {
    design.missing.push_back(design_without(absent, discrete, steady, options.qh_percent2));
  }
  return design;
}

}  // namespace ehm::bench
