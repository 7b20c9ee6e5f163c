// SPDX-License-Identifier: Apache-2.0
#pragma once
// The best choice of t health parameters as tuners, exactly: the Kalman filter and its error theory (kalman_error.h)
// for every one of the C(p, t) subsets, ranked by the relative error J (relative_error.h). A subset that the sensors
// cannot tell apart has no filter and drops out. Equal J: the subset that comes first in lexicographic order.

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "tuner_design/theory/relative_error.h"

namespace ehm::tuner_design {

struct BestSubset {
  std::vector<int> health;      ///< indices, ascending
  design::SubsetDesign filter;  ///< V: these rows of the identity
  std::size_t subsets = 0;      ///< C(p, t)
  std::size_t without_filter = 0;
};

/// The filter on V over all sensors, with its error theory; nullopt if the sensors cannot tell these tuners apart in
/// the steady state (observability.h), or so badly that a solver fails. `model` is discrete and scaled.
std::optional<design::SubsetDesign> filter_on_tuners(const linear_model::LinearModel& model,
                                                     const estimation::SteadyGain& steady, const Eigen::MatrixXd& V,
                                                     double qh_percent2);

/// Error of a filter over the fleet on the linear engine: its totals without the linearisation error.
design::ErrorByChannel linear_error(const design::SubsetDesign& filter);

/// All subsets of t of p, each ascending, in lexicographic order. @throws std::invalid_argument unless 1 <= t <= p
/// <= 30.
std::vector<std::vector<int>> all_subsets(int p, int t);

/// nullopt if no subset has a filter. The result does not depend on the number of threads; `progress` gets the number
/// of subsets done. @throws std::invalid_argument if t is not within 1 and p.
std::optional<BestSubset> best_subset(
    const linear_model::LinearModel& model, const estimation::SteadyGain& steady, int t, double qh_percent2,
    const RelativeError& merit, unsigned threads,
    const std::function<void(std::size_t)>& progress = [](std::size_t) {});

}  // namespace ehm::tuner_design
