// SPDX-License-Identifier: Apache-2.0
#pragma once
// The study of single operating points for people and as JSON with the same numbers.

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "tuner_design/points/point_study.h"

namespace ehm::tuner_design {

void print_point_study(const PointStudy& study, std::ostream& out);
nlohmann::ordered_json point_study_as_json(const PointStudy& study);

}  // namespace ehm::tuner_design
