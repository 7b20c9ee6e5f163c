// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table of Simon & Garg as rows and columns, ours and theirs, and how it reads. Errors: none.

#include "tuner_design/report/page/data_table.h"
#include "tuner_design/studies/simon_garg.h"

namespace ehm::tuner_design::report {

inline constexpr const char* simon_garg_reading =
    "Rows a to d are tuners searched for the least MAP error of health, e to h for that of the auxiliary outputs, each "
    "from its own random start. Their engine is C-MAPSS, not this one: the published numbers are context, no target.";

DataTable simon_garg_table_data(const SimonGargStudy& study);

}  // namespace ehm::tuner_design::report
