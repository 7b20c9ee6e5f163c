// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables IV and V and figures 5.4 and 5.5 of Endurthi's thesis: ours, with the tangent, beside what was published; for
// people, as JSON and CSV, which have all filters, whichever table was asked for.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/endurthi/health_study.h"

namespace ehm::tuner_design {

/// `table`: 4 (unconstrained) or 5 (constrained).
void print_health_study(const endurthi::HealthStudy& study, int table, std::ostream& out);
nlohmann::ordered_json health_study_as_json(const endurthi::HealthStudy& study);
/// A line a model and filter, then a line a flight of the long run.
std::string health_study_csv(const endurthi::HealthStudy& study);

}  // namespace ehm::tuner_design
