// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/nearest_name.h"

#include <algorithm>
#include <numeric>

namespace ehm::config {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  // Distances from the first i, i-1 and i-2 characters of a to each beginning of b.
  std::vector<std::size_t> row(b.size() + 1), before(b.size() + 1), before_that(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_that.swap(before);
    before.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({before[j] + 1, row[j - 1] + 1, before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_that[j - 2] + 1);
    }
  }
  return row.back();
}

std::string nearest_name(const std::string& written, const std::vector<std::string>& known) {
  constexpr std::size_t most_edits = 3;
  const std::size_t letters = written.size() - std::min(written.find_first_not_of('-'), written.size());
  std::size_t allowed = std::min(most_edits, letters / 3);
  std::string best;
  for (const auto& candidate : known) {
    const std::size_t distance = edit_distance(written, candidate);
    if (best.empty() ? distance <= allowed : distance < allowed) best = candidate, allowed = distance;
  }
  return best;
}

}  // namespace ehm::config
