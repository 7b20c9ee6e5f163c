// SPDX-License-Identifier: Apache-2.0
#pragma once
// Break points must lie within the samples that they are fitted to: beyond, the coefficients would be extrapolation.

#include <string>
#include <vector>

#include "engine_sim/map_fit/fit_settings.h"

namespace ehm::engine_sim {

/// @throws files::FileError naming the settings file, `key`, the break point and the range, if one lies outside
///         `lowest` to `highest` (but for rounding)
void check_breaks(const SettingsPlace& place, const std::string& key, const std::vector<double>& breaks, double lowest,
                  double highest);

}  // namespace ehm::engine_sim
