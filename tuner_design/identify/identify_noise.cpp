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
#include "tuner_design/identify/noise_groups.h"
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
constexpr double start_share = 1e-6, least_eigenvalue = 1e-12;

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

/// What is left of the information on the walks once all else is estimated too, each scaled to itself.
MatrixXd information_on_walks(const WhittleFit& fit, Index first) {
  const Index p = fit.theta.size() - first;
  const MatrixXd others = fit.information.topLeftCorner(first, first);
  const MatrixXd cross = fit.information.topRightCorner(first, p);
  const MatrixXd own = fit.information.bottomRightCorner(p, p) - cross.transpose() * others.ldlt().solve(cross);
  const VectorXd scale = own.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * own * scale.asDiagonal();
}

/// Of the errors of each pair of walks the most negative correlation: what one gains, the other loses. `channels`: the
/// health parameters of the groups behind `first`.
void tell_apart(const WhittleFit& fit, Index first, const std::vector<int>& channels, IdentifiedNoise& result) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(information_on_walks(fit, first));
  const VectorXd values = eigen.eigenvalues().cwiseMax(least_eigenvalue);
  result.condition = values(values.size() - 1) / values(0);
  const MatrixXd errors = eigen.eigenvectors() * values.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  for (Index i = 0; i < values.size(); ++i) {
    IdentifiedWalk& walk = result.walks[as_size(channels[as_size(i)])];
    for (Index j = 0; j < values.size(); ++j) {
      const double correlation = errors(i, j) / std::sqrt(errors(i, i) * errors(j, j));
      if (correlation < walk.correlation) walk.correlation = correlation, walk.alike = channels[as_size(j)];
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

void fit_noise(const std::vector<SpectralBand>& bands, const std::vector<NoiseTerm>& terms, const LinearModel& scaled,
               const VectorXd& power, IdentifiedNoise& result) {
  const NoiseGroups each = one_each(bands, terms), common = common_walk(each, terms);
  const auto first = as_index(common.size()) - 1, walks = as_index(each.size()) - first;
  if (terms[common.back().front()].kind != NoiseKind::walk)
    throw std::invalid_argument("no sensor that is used sees anything of health");
  const VectorXd start = start_values(common, terms, scaled, power);
  const WhittleFit together = whittle_fit(bands, common, start);
  VectorXd apart_start(first + walks);
  apart_start << together.theta, VectorXd::Constant(walks - 1, together.theta(first));
  const WhittleFit apart = whittle_fit(bands, each, apart_start.cwiseMax(start_share * start.minCoeff()));
  result.walk = identified(together, first);
  result.walks_differ = walks > 1 && together.deviance - apart.deviance >
                                         monitor::chi_square_quantile(static_cast<double>(walks - 1),
                                                                      monitor::normal_quantile_above(0.01));
  std::vector<int> channels;
  for (std::size_t g = 0; g < each.size(); ++g) {
    const NoiseTerm& term = terms[each[g].front()];
    const bool walk = term.kind == NoiseKind::walk;
    const IdentifiedVariance variance = identified(walk || result.walks_differ ? apart : together, as_index(g));
    if (walk) {
      result.walks[as_size(term.channel)].variance = variance;
      result.walks[as_size(term.channel)].seen = true;
      channels.push_back(term.channel);
    } else if (term.kind == NoiseKind::sensor) {
      result.sensors[as_size(result.selection.sensors[as_size(term.channel)])] = variance;
    } else {
      result.motion_terms.push_back(term);
      result.motion.push_back(variance);
    }
  }
  tell_apart(apart, first, channels, result);
  remark(noise_checks(bands, each, apart), result);
  judge_fit(bands, each, apart, result);
}

/// What a model should count with.
double told_or_least(const IdentifiedVariance& found, double scale, double models) {
  return found.told ? scale * found.value : std::min(models, scale * found.high);
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
  fit_noise(bands, spectra.terms(), scaled, power, result);
  return result;
}

LinearModel with_identified_noise(const LinearModel& model, const IdentifiedNoise& noise) {
  LinearModel result = model;
  for (std::size_t i = 0; i < noise.sensors.size(); ++i) {
    if (!noise.sensors[i]) continue;
    double& sigma = result.sensor_noise_sigma(as_index(i));
    sigma = std::sqrt(told_or_least(*noise.sensors[i], std::pow(noise.scaling.sensor(as_index(i)), 2), sigma * sigma));
  }
  for (std::size_t t = 0; t < noise.motion.size(); ++t) {
    const Index state = noise.motion_terms[t].channel;
    const double variance = state < 0 ? told_or_least(noise.motion[t], 1.0, 1.0)
                                      : told_or_least(noise.motion[t], std::pow(noise.scaling.state(state), 2),
                                                      model.process_noise(state, state));
    if (state < 0)
      result.process_noise *= variance;
    else
      result.process_noise(state, state) = variance;
  }
  return result;
}

}  // namespace ehm::tuner_design
