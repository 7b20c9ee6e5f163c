// SPDX-License-Identifier: Apache-2.0
#pragma once
// Percentiles of measured values as a bench prints them.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ehm::tuner_design {

/// The smallest value that at least `share` of all values do not exceed; 0 of none. `values` is reordered.
inline double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto wanted = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::min(wanted, values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Of consecutive blocks of `size` values each, the median of their percentiles: a rare disturbance of the machine
/// spoils the blocks that it hits, not the figure.
inline double median_of_blocks(const std::vector<double>& values, std::size_t size, double share) {
  std::vector<double> each;
  for (std::size_t first = 0; first + size <= values.size(); first += size) {
    std::vector<double> block(values.begin() + static_cast<std::ptrdiff_t>(first),
                              values.begin() + static_cast<std::ptrdiff_t>(first + size));
    each.push_back(percentile(block, share));
  }
  return percentile(each, 0.5);
}

}  // namespace ehm::tuner_design
