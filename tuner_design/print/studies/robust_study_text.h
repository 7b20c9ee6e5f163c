// SPDX-License-Identifier: Apache-2.0
#pragma once
// The study of the robust gain for people and as JSON with the same numbers.

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "tuner_design/robust/robust_study.h"

namespace ehm::tuner_design {

/// As published, tables 5.2 and 5.3 of Kosanam's thesis, averages of eight health parameters of another engine: robust
/// over standard filter with wrong noise, and with noise as modelled.
inline constexpr double published_wrong_ratio = 10.7 / 11.3, published_nominal_ratio = 5.2 / 4.9;

void print_robust_study(const RobustStudy& study, std::ostream& out);
nlohmann::ordered_json robust_study_as_json(const RobustStudy& study);

}  // namespace ehm::tuner_design
