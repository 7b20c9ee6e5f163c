// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/identify/noise_checks.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXcd extra_spectrum(const SpectralBand& band, const NoiseCheck& check) {
  const auto shape = [&](int i) { return band.spectra[as_size(i)](i, i).real(); };
  MatrixXcd S = MatrixXcd::Zero(band.power.rows(), band.power.cols());
  if (check.sensor == check.other)
    S(check.sensor, check.sensor) = 2.0 * std::cos(band.omega) * shape(check.sensor);
  else
    S(check.sensor, check.other) = S(check.other, check.sensor) = std::sqrt(shape(check.sensor) * shape(check.other));
  return S;
}

/// tr(A B), real
double trace_of_product(const MatrixXcd& A, const MatrixXcd& B) {
  return A.cwiseProduct(B.transpose()).sum().real();
}

struct Score {
  double slope = 0.0, own = 0.0;
  VectorXd coupling;
};

}  // namespace

std::vector<NoiseCheck> noise_checks(const std::vector<SpectralBand>& bands, const NoiseGroups& groups,
                                     const WhittleFit& fit) {
  const auto m = static_cast<int>(bands.front().power.rows());
  std::vector<NoiseCheck> checks;
  for (int i = 0; i < m; ++i)
    for (int j = i + 1; j < m; ++j) checks.push_back({i, j});
  for (int i = 0; i < m; ++i) checks.push_back({i, i});
  std::vector<Score> scores(checks.size(), {0.0, 0.0, VectorXd::Zero(fit.theta.size())});
  std::vector<MatrixXcd> known(groups.size());
  for (const SpectralBand& band : bands) {
    const MatrixXcd S = spectrum(band, groups, fit.theta);
    const Eigen::LLT<MatrixXcd> factor(S);
    const MatrixXcd excess = factor.solve(band.power - S);
    const double weight = independent_share * band.bins;
    for (std::size_t g = 0; g < groups.size(); ++g) known[g] = factor.solve(group_spectrum(band, groups[g]));
    for (std::size_t c = 0; c < checks.size(); ++c) {
      const MatrixXcd extra = factor.solve(extra_spectrum(band, checks[c]));
      scores[c].slope += weight * trace_of_product(extra, excess);
      scores[c].own += weight * trace_of_product(extra, extra);
      for (std::size_t g = 0; g < groups.size(); ++g)
        scores[c].coupling(as_index(g)) += weight * trace_of_product(extra, known[g]);
    }
  }
  for (std::size_t c = 0; c < checks.size(); ++c) {
    const Score& score = scores[c];
    const double information = score.own - score.coupling.dot(fit.covariance * score.coupling);
    if (!(information > 0.0)) continue;  // the fit cannot tell it from what it has
    const double size = std::sqrt(fit.theta(checks[c].sensor) * fit.theta(checks[c].other));
    checks[c].correlation = score.slope / information / size;
    checks[c].standard_error = 1.0 / std::sqrt(information) / size;
  }
  return checks;
}

PowerRatio power_ratio(const std::vector<SpectralBand>& bands, const NoiseGroups& groups, const WhittleFit& fit,
                       double low, double high) {
  double bins = 0.0;
  VectorXd sum = VectorXd::Zero(bands.front().power.rows());
  for (const SpectralBand& band : bands) {
    if (band.omega < low || band.omega >= high) continue;
    const VectorXd modelled = spectrum(band, groups, fit.theta).diagonal().real();
    sum += band.bins * band.power.diagonal().real().cwiseQuotient(modelled);
    bins += band.bins;
  }
  if (bins == 0.0) return {};
  return {sum / bins, 1.0 / std::sqrt(independent_share * bins)};
}

}  // namespace ehm::tuner_design
