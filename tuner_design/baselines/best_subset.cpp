// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/baselines/best_subset.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/linear/solver_error.h"
#include "tuner_design/theory/kalman_error.h"
#include "tuner_design/theory/kalman_gain.h"
#include "tuner_design/theory/map_estimator.h"
#include "tuner_design/theory/observability.h"
#include "tuner_design/theory/prepared_point.h"

namespace ehm::tuner_design {
namespace {

/// Rows of the identity.
Eigen::MatrixXd chosen_rows(const std::vector<int>& health, Eigen::Index p) {
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(as_index(health.size()), p);
  for (std::size_t i = 0; i < health.size(); ++i) V(as_index(i), health[i]) = 1.0;
  return V;
}

}  // namespace

std::optional<design::SubsetDesign> filter_on_tuners(const linear_model::LinearModel& model,
                                                     const estimation::SteadyGain& steady, const Eigen::MatrixXd& V,
                                                     double qh_percent2) {
  const Eigen::MatrixXd seen = model.sensor_noise_sigma.cwiseInverse().asDiagonal() * steady.H * right_inverse(V);
  if (seen_rank(Eigen::JacobiSVD<Eigen::MatrixXd>(seen).singularValues()) < V.rows()) return std::nullopt;
  try {
    design::SubsetDesign filter = kalman_gain(model, all_sensors(model), V, qh_percent2);
    add_error_theory(filter, model, steady);
    return filter;
  } catch (const estimation::SolverError&) {  // told apart so badly that the solvers lose their digits
    return std::nullopt;
  }
}

design::ErrorByChannel linear_error(const design::SubsetDesign& filter) {
  return {(filter.health_total_covariance - filter.health_linearisation_covariance).diagonal(),
          (filter.auxiliary_total_covariance - filter.auxiliary_linearisation_covariance).diagonal()};
}

std::vector<std::vector<int>> all_subsets(int p, int t) {
  if (t < 1 || t > p || p > 30) {
    throw std::invalid_argument("subsets of " + std::to_string(t) + " of " + std::to_string(p) +
                                "; allowed: 1 to all of at most 30");
  }
  std::vector<std::vector<int>> subsets;
  for (std::uint32_t mask = 0; mask < (1U << static_cast<unsigned>(p)); ++mask) {
    if (std::popcount(mask) != t) continue;
    auto& subset = subsets.emplace_back();
    for (int i = 0; i < p; ++i) {
      if ((mask >> static_cast<unsigned>(i) & 1U) != 0) subset.push_back(i);
    }
  }
  std::sort(subsets.begin(), subsets.end());
  return subsets;
}

std::optional<BestSubset> best_subset(const linear_model::LinearModel& model, const estimation::SteadyGain& steady,
                                      int t, double qh_percent2, const RelativeError& merit, unsigned threads,
                                      const std::function<void(std::size_t)>& progress) {
  const Eigen::Index p = model.L.cols();
  const std::vector<std::vector<int>> subsets = all_subsets(static_cast<int>(p), t);
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> value(subsets.size(), none);
  long_work::parallel_for(
      subsets.size(), threads,
      [&](std::size_t i) {
        const auto filter = filter_on_tuners(model, steady, chosen_rows(subsets[i], p), qh_percent2);
        if (filter) value[i] = merit(linear_error(*filter));
      },
      progress);
  const auto least = std::min_element(value.begin(), value.end());
  if (*least == none) return std::nullopt;
  const auto& health = subsets[as_size(least - value.begin())];
  return BestSubset{health, filter_on_tuners(model, steady, chosen_rows(health, p), qh_percent2).value(),
                    subsets.size(), as_size(std::count(value.begin(), value.end(), none))};
}

}  // namespace ehm::tuner_design
