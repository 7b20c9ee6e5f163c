// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/identify/noise_groups.h"

#include <algorithm>

#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

constexpr double least_start_percent2 = 1e-6;

}  // namespace

NoiseGroups one_each(const std::vector<SpectralBand>& bands, const std::vector<NoiseTerm>& terms) {
  NoiseGroups groups;
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (std::any_of(bands.begin(), bands.end(), [t](const SpectralBand& b) { return !b.spectra[t].isZero(0.0); }))
      groups.push_back({t});
  return groups;
}

NoiseGroups common_walk(const NoiseGroups& each, const std::vector<NoiseTerm>& terms) {
  NoiseGroups groups;
  std::vector<std::size_t> walks;
  for (const auto& group : each) {
    if (terms[group.front()].kind == NoiseKind::walk)
      walks.push_back(group.front());
    else
      groups.push_back(group);
  }
  if (!walks.empty()) groups.push_back(walks);
  return groups;
}

Eigen::VectorXd start_values(const NoiseGroups& groups, const std::vector<NoiseTerm>& terms,
                             const linear_model::LinearModel& scaled, const Eigen::VectorXd& power) {
  Eigen::VectorXd start(as_index(groups.size()));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const NoiseTerm& term = terms[groups[g].front()];
    double& value = start(as_index(g));
    if (term.kind == NoiseKind::sensor)
      value = 0.5 * power(term.channel);
    else if (term.kind == NoiseKind::walk)
      value = least_start_percent2;
    else
      value = term.channel < 0 ? 1.0 : std::max(least_start_percent2, scaled.process_noise(term.channel, term.channel));
  }
  return start;
}

}  // namespace ehm::tuner_design
