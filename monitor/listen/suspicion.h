// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sensors whose mean lies more than five spreads from what is expected, and what would explain each: two channels
// swapped, or another unit.

#include <string>
#include <vector>

#include "monitor/listen/expectation.h"

namespace ehm::monitor {

inline constexpr double implausible_spreads = 5.0;

/// One line a suspicious sensor; `mean` is NaN where there was no value.
std::vector<std::string> suspicions(const std::vector<linear_model::Channel>& sensors, const Eigen::VectorXd& mean,
                                    const Expectation& expectation);

}  // namespace ehm::monitor
