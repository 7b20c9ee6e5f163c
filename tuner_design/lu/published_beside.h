// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the paper prints of a case of ours, where it prints anything (published_lu.h). Errors: none.

#include <optional>
#include <string>

#include "tuner_design/lu/lu_study.h"
#include "tuner_design/lu/published_lu.h"

namespace ehm::tuner_design {

/// "EKF", as in the paper.
std::string filter_name(const LuCase& of);

/// Of tables 4 and 5; null where the paper has no such case.
const published::Lu* published_parameters(const LuStudy& study, const LuCase& of);
/// SME of it, percent.
double sum_of_means(const published::Lu& figures);

/// Of tables 6 to 9, `index` is the case's place: SME in percent, of table 7 seconds a second; below 0: diverged.
std::optional<double> published_figure(const LuStudy& study, std::size_t index);

}  // namespace ehm::tuner_design
