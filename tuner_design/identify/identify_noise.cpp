// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/identify/identify_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/discretise.h"
#include "monitor/diagnosis/quantiles.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "tuner_design/identify/model_residual.h"
#include "tuner_design/identify/short_holes.h"

namespace ehm::tuner_design {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using linear_model::LinearModel;

constexpr Index least_samples = 2000;
constexpr double told_share = 0.5, two_sided_95 = 1.96, one_sided_95 = 1.645;
constexpr double false_remark = 0.01, least_correlation = 0.02;
constexpr double start_walk_percent2 = 1e-6, start_share = 1e-6, least_eigenvalue = 1e-12;

/// The rows of some sensors.
LinearModel with_sensors(const LinearModel& model, const std::vector<int>& sensors) {
  LinearModel part = model;
  part.sensors.clear();
  for (const int i : sensors) part.sensors.push_back(model.sensors[as_size(i)]);
  part.sensor_noise_sigma = model.sensor_noise_sigma(sensors);
  if (model.sensor_resolution.size() > 0) part.sensor_resolution = model.sensor_resolution(sensors);
  if (model.sensor_update_period_s.size() > 0) part.sensor_update_period_s = model.sensor_update_period_s(sensors);
  part.C = model.C(sensors, Eigen::all);
  part.D = model.D(sensors, Eigen::all);
  part.M = model.M(sensors, Eigen::all);
  part.linearisation_error.resize(0, 0);
  return part;
}

void require_enough(const SteadySelection& s) {
  if (s.used >= least_samples) return;
  throw std::invalid_argument("has " + std::to_string(s.used) +
                              " steady samples at the model's point; allowed: " + std::to_string(least_samples) +
                              " or more. Of " + std::to_string(s.recorded) + " recorded, " + std::to_string(s.missing) +
                              " lack a value, " + std::to_string(s.off_point) + " are off the point, " +
                              std::to_string(s.moving) + " are moving to another one, " + std::to_string(s.too_short) +
                              " stand in pieces of fewer than " + std::to_string(s.least_length) + " (" +
                              std::to_string(s.gaps) + " gaps, " + std::to_string(s.jumps) +
                              " jumps of a sensor). Record longer at one point, or name a model of the point flown");
}

void require_noise(const LinearModel& model, const std::vector<int>& sensors, const VectorXd& power) {
  for (std::size_t i = 0; i < sensors.size(); ++i)
    if (!(power(as_index(i)) > 0.0))
      throw std::invalid_argument("sensor " + model.sensors[as_size(sensors[i])].name +
                                  " reads one value throughout: it is stuck, or not connected; a model without it can "
                                  "be identified");
}

/// Mean square of each row over all pieces.
VectorXd mean_power(const std::vector<MatrixXd>& pieces) {
  VectorXd sum = VectorXd::Zero(pieces.front().rows());
  double count = 0.0;
  for (const MatrixXd& piece : pieces) {
    sum += piece.rowwise().squaredNorm();
    count += static_cast<double>(piece.cols());
  }
  return sum / count;
}

IdentifiedVariance identified(const WhittleFit& fit, Index group) {
  IdentifiedVariance v{.value = fit.theta(group), .standard_error = fit.standard_error(group)};
  v.told = v.standard_error <= told_share * v.value;
  if (v.told) {
    const double nu = 2.0 * std::pow(v.value / v.standard_error, 2);
    v.low = v.value * nu / monitor::chi_square_quantile(nu, two_sided_95);
    v.high = v.value * nu / monitor::chi_square_quantile(nu, -two_sided_95);
  } else {
    v.high = upper_end(fit, group, one_sided_95);
  }
  return v;
}

/// One group a term, but all walks in the last one.
NoiseGroups common_walk(const std::vector<NoiseTerm>& terms) {
  NoiseGroups groups;
  std::vector<std::size_t> walks;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (terms[t].kind == NoiseKind::walk)
      walks.push_back(t);
    else
      groups.push_back({t});
  }
  groups.push_back(walks);
  return groups;
}

NoiseGroups one_each(std::size_t terms) {
  NoiseGroups groups;
  for (std::size_t t = 0; t < terms; ++t) groups.push_back({t});
  return groups;
}

/// Everything that is not noise of the sensors starts from the model's, and above 0.
VectorXd start_of(const NoiseSpectra& spectra, const LinearModel& scaled, const VectorXd& power) {
  const std::size_t before_walks = spectra.terms().size() - as_size(scaled.L.cols());
  VectorXd start(as_index(before_walks + 1));
  for (std::size_t t = 0; t < before_walks; ++t) {
    const NoiseTerm& term = spectra.terms()[t];
    double& value = start(as_index(t));
    if (term.kind == NoiseKind::sensor)
      value = 0.5 * power(term.channel);
    else
      value = term.channel < 0 ? 1.0 : std::max(start_walk_percent2, scaled.process_noise(term.channel, term.channel));
  }
  start(start.size() - 1) = start_walk_percent2;
  return start;
}

/// What is left of the information on the walks once all else is estimated too, each scaled to itself.
MatrixXd information_on_walks(const WhittleFit& fit, Index first, Index p) {
  const MatrixXd others = fit.information.topLeftCorner(first, first);
  const MatrixXd cross = fit.information.topRightCorner(first, p);
  const MatrixXd own = fit.information.bottomRightCorner(p, p) - cross.transpose() * others.ldlt().solve(cross);
  const VectorXd scale = own.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * own * scale.asDiagonal();
}

/// Of the errors of each pair of walks the most negative correlation: what one gains, the other loses.
void tell_apart(const WhittleFit& fit, Index first, IdentifiedNoise& result) {
  const auto p = as_index(result.walks.size());
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(information_on_walks(fit, first, p));
  const VectorXd values = eigen.eigenvalues().cwiseMax(least_eigenvalue);
  result.condition = values(p - 1) / values(0);
  const MatrixXd errors = eigen.eigenvectors() * values.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  for (Index i = 0; i < p; ++i) {
    IdentifiedWalk& walk = result.walks[as_size(i)];
    for (Index j = 0; j < p; ++j) {
      const double correlation = errors(i, j) / std::sqrt(errors(i, i) * errors(j, j));
      if (correlation < walk.correlation) walk.correlation = correlation, walk.alike = static_cast<int>(j);
    }
  }
}

void remark(std::vector<NoiseCheck> checks, IdentifiedNoise& result) {
  const double z = monitor::normal_quantile_above(0.5 * false_remark / static_cast<double>(checks.size()));
  // A mended value is correlated by a half with each of its two neighbours.
  const double least = least_correlation + 2.0 * static_cast<double>(result.mended) /
                                               static_cast<double>(std::max(Index{1}, result.selection.recorded));
  for (NoiseCheck check : checks) {
    if (std::abs(check.correlation) < std::max(least, z * check.standard_error)) continue;
    check.sensor = result.selection.sensors[as_size(check.sensor)];
    check.other = result.selection.sensors[as_size(check.other)];
    result.checks.push_back(check);
  }
}

void judge_fit(const std::vector<SpectralBand>& bands, const NoiseGroups& groups, const WhittleFit& fit,
               IdentifiedNoise& result) {
  const double radius = estimation::spectral_radius(result.model.A);
  const double corner = radius > 0.0 ? -std::log(radius) : 1.0;
  result.range_rad = {0.1 * corner, std::min(10.0 * corner, 1.0)};
  const double all = std::numeric_limits<double>::infinity();
  result.fit = {power_ratio(bands, groups, fit, 0.0, result.range_rad[0]),
                power_ratio(bands, groups, fit, result.range_rad[0], result.range_rad[1]),
                power_ratio(bands, groups, fit, result.range_rad[1], all)};
}

void fit_noise(const std::vector<SpectralBand>& bands, const NoiseSpectra& spectra, const VectorXd& start,
               IdentifiedNoise& result) {
  const NoiseGroups common = common_walk(spectra.terms()), each = one_each(spectra.terms().size());
  const WhittleFit together = whittle_fit(bands, common, start);
  const auto p = as_index(result.walks.size()), first = start.size() - 1;
  VectorXd apart_start(first + p);
  apart_start << together.theta, VectorXd::Constant(p - 1, together.theta(first));
  const WhittleFit apart = whittle_fit(bands, each, apart_start.cwiseMax(start_share * start.minCoeff()));
  for (std::size_t t = 0; t < as_size(first); ++t) {
    const NoiseTerm& term = spectra.terms()[t];
    const IdentifiedVariance variance = identified(together, as_index(t));
    if (term.kind == NoiseKind::sensor) {
      result.sensors[as_size(result.selection.sensors[as_size(term.channel)])] = variance;
    } else {
      result.motion_terms.push_back(term);
      result.motion.push_back(variance);
    }
  }
  result.walk = identified(together, first);
  for (Index i = 0; i < p; ++i) result.walks[as_size(i)].variance = identified(apart, first + i);
  tell_apart(apart, first, result);
  result.walks_differ =
      p > 1 && together.deviance - apart.deviance >
                   monitor::chi_square_quantile(static_cast<double>(p - 1), monitor::normal_quantile_above(0.01));
  remark(noise_checks(bands, each, apart), result);
  judge_fit(bands, each, apart, result);
}

}  // namespace

IdentifiedNoise identify_noise(RecordedSamples record, const LinearModel& model,
                               const monitor::ValidityOptions& validity) {
  IdentifiedNoise result;
  result.mended = mend_short_holes(record);
  result.model = linear_model::discretise(model);
  result.scaling = linear_model::scaling_of(result.model);
  result.selection = select_steady(record, result.model, validity);
  result.sensors.resize(model.sensors.size());
  result.walks.resize(model.health.size());
  const std::vector<int>& used = result.selection.sensors;
  require_enough(result.selection);
  const LinearModel scaled = with_sensors(linear_model::scaled(result.model, result.scaling), used);
  std::vector<MatrixXd> pieces;
  for (const Span& segment : result.selection.segments)
    pieces.push_back(differenced_residual(record, segment, scaled, used, result.scaling.sensor(used)));
  const VectorXd power = mean_power(pieces);
  require_noise(model, used, power);
  const NoiseSpectra spectra(scaled);
  const std::vector<SpectralBand> bands = spectral_bands(pieces, spectra);
  result.lowest_rad = bands.front().omega;
  fit_noise(bands, spectra, start_of(spectra, scaled, power), result);
  return result;
}

LinearModel with_identified_noise(const LinearModel& model, const IdentifiedNoise& noise) {
  LinearModel result = model;
  for (std::size_t i = 0; i < noise.sensors.size(); ++i)
    if (const auto& variance = noise.sensors[i])
      result.sensor_noise_sigma(as_index(i)) = std::sqrt(variance->value) * noise.scaling.sensor(as_index(i));
  for (std::size_t t = 0; t < noise.motion.size(); ++t) {
    const IdentifiedVariance& found = noise.motion[t];
    const Index state = noise.motion_terms[t].channel;
    const double scale = state < 0 ? 1.0 : std::pow(noise.scaling.state(state), 2);
    const double models = state < 0 ? 1.0 : model.process_noise(state, state);
    const double variance = found.told ? scale * found.value : std::min(models, scale * found.high);
    if (state < 0)
      result.process_noise *= variance;
    else
      result.process_noise(state, state) = variance;
  }
  return result;
}

}  // namespace ehm::tuner_design
