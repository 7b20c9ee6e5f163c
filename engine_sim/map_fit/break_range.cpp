// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/map_fit/break_range.h"

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/map_fit/checked_numbers.h"

namespace ehm::engine_sim {

void check_breaks(const SettingsPlace& place, const std::string& key, const std::vector<double>& breaks, double lowest,
                  double highest) {
  const double rounding = 1e-9 * (highest - lowest);
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    if (breaks[i] >= lowest - rounding && breaks[i] <= highest + rounding) continue;
    files::throw_defect(place.file, place.key + "." + key + "[" + std::to_string(i) + "]", files::shown(breaks[i]),
                        range_text(lowest, highest), "That is what the table and its continuation cover");
  }
}

}  // namespace ehm::engine_sim
