// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/identify/whittle_fit.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "tuner_design/identify/nonnegative_fit.h"

namespace ehm::tuner_design {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int most_iterations = 200, most_halvings = 20, most_doublings = 60, bisections = 30;
constexpr double settled = 1e-7, least_share = 1e-9, least_eigenvalue = 1e-12;

double deviance_of(const std::vector<SpectralBand>& bands, const NoiseGroups& groups, const VectorXd& theta) {
  double sum = 0.0;
  for (const SpectralBand& band : bands) {
    const Eigen::LLT<MatrixXcd> factor(spectrum(band, groups, theta));
    if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    const double log_det = 2.0 * factor.matrixLLT().diagonal().real().array().log().sum();
    sum += band.bins * (log_det + factor.solve(band.power).trace().real());
  }
  return 2.0 * independent_share * sum;
}

struct NormalEquations {
  MatrixXd F;
  VectorXd b;
};

NormalEquations normal_equations(const std::vector<SpectralBand>& bands, const NoiseGroups& groups,
                                 const VectorXd& theta) {
  const auto k = as_index(groups.size());
  NormalEquations sums{MatrixXd::Zero(k, k), VectorXd::Zero(k)};
  std::vector<MatrixXcd> whitened(groups.size());
  for (const SpectralBand& band : bands) {
    const Eigen::LLT<MatrixXcd> factor(spectrum(band, groups, theta));
    const double weight = independent_share * band.bins;
    const MatrixXcd measured = factor.solve(band.power).transpose();
    for (std::size_t g = 0; g < groups.size(); ++g) whitened[g] = factor.solve(group_spectrum(band, groups[g]));
    for (std::size_t g = 0; g < groups.size(); ++g) {
      sums.b(as_index(g)) += weight * whitened[g].cwiseProduct(measured).sum().real();
      const MatrixXcd turned = whitened[g].transpose();
      for (std::size_t h = 0; h <= g; ++h)
        sums.F(as_index(g), as_index(h)) += weight * turned.cwiseProduct(whitened[h]).sum().real();
    }
  }
  sums.F = sums.F.selfadjointView<Eigen::Lower>();
  return sums;
}

}  // namespace

MatrixXcd group_spectrum(const SpectralBand& band, const std::vector<std::size_t>& group) {
  MatrixXcd sum = band.spectra[group.front()];
  for (std::size_t i = 1; i < group.size(); ++i) sum += band.spectra[group[i]];
  return sum;
}

MatrixXcd spectrum(const SpectralBand& band, const NoiseGroups& groups, const VectorXd& theta) {
  MatrixXcd sum = MatrixXcd::Zero(band.power.rows(), band.power.cols());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const std::size_t term : groups[g]) sum += theta(as_index(g)) * band.spectra[term];
  return sum;
}

namespace {

/// Of a positive semidefinite matrix; a direction that it does not hold gets a very large value.
MatrixXd inverse_of(const MatrixXd& F) {
  const VectorXd scale = F.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(scale.asDiagonal() * F * scale.asDiagonal()));
  const MatrixXd vectors = scale.asDiagonal() * eigen.eigenvectors();
  return vectors * eigen.eigenvalues().cwiseMax(least_eigenvalue).cwiseInverse().asDiagonal() * vectors.transpose();
}

void add_uncertainty(WhittleFit& fit) {
  std::vector<Index> free;
  for (Index g = 0; g < fit.theta.size(); ++g)
    if (fit.theta(g) > 0.0) free.push_back(g);
  fit.standard_error = inverse_of(fit.information).diagonal().cwiseSqrt();
  fit.covariance = MatrixXd::Zero(fit.theta.size(), fit.theta.size());
  fit.covariance(free, free) = inverse_of(fit.information(free, free));
}

}  // namespace

double upper_end(const WhittleFit& fit, Index group, double sigmas) {
  std::vector<Index> others;
  for (Index g = 0; g < fit.theta.size(); ++g)
    if (g != group) others.push_back(g);
  const MatrixXd& F = fit.information;
  const MatrixXd F_others = F(others, others);
  const VectorXd coupling = F(others, group), b_others = fit.right(others);
  /// 1/2 theta^T F theta - b^T theta, least over the others
  const auto least = [&](double value) {
    const VectorXd right = b_others - value * coupling, rest = nonnegative_fit(F_others, right);
    return 0.5 * rest.dot(F_others * rest) - right.dot(rest) +
           value * (0.5 * F(group, group) * value - fit.right(group));
  };
  const double allowed = least(fit.theta(group)) + 0.5 * sigmas * sigmas;
  double low = fit.theta(group), high = low + sigmas / std::sqrt(F(group, group));
  for (int i = 0; i < most_doublings && least(high) < allowed; ++i) high = low + 2.0 * (high - low);
  for (int i = 0; i < bisections; ++i) {
    const double middle = 0.5 * (low + high);
    (least(middle) < allowed ? low : high) = middle;
  }
  return high;
}

WhittleFit whittle_fit(const std::vector<SpectralBand>& bands, const NoiseGroups& groups, const VectorXd& start) {
  WhittleFit fit;
  fit.theta = start;
  fit.deviance = deviance_of(bands, groups, start);
  while (fit.iterations++ < most_iterations) {
    const NormalEquations equations = normal_equations(bands, groups, fit.theta);
    VectorXd next = nonnegative_fit(equations.F, equations.b);
    // A sensor without any noise would make S singular.
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (groups[g].front() < as_size(bands.front().power.rows()))
        next(as_index(g)) = std::max(next(as_index(g)), least_share * start(as_index(g)));
    double share = 1.0, deviance = deviance_of(bands, groups, next);
    for (int i = 0; i < most_halvings && !(deviance <= fit.deviance); ++i) {
      share *= 0.5;
      deviance = deviance_of(bands, groups, fit.theta + share * (next - fit.theta));
    }
    if (!(deviance <= fit.deviance)) break;
    const double gain = fit.deviance - deviance;
    // In full steps an unknown that goes to 0 is there exactly.
    fit.theta = share == 1.0 ? next : fit.theta + share * (next - fit.theta);
    fit.deviance = deviance;
    if (share == 1.0 && gain < settled) break;
  }
  const NormalEquations equations = normal_equations(bands, groups, fit.theta);
  fit.information = equations.F;
  fit.right = equations.b;
  add_uncertainty(fit);
  return fit;
}

}  // namespace ehm::tuner_design
