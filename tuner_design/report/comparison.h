// SPDX-License-Identifier: Apache-2.0
#pragma once
// The design beside everything it is compared with (tuner_design/baselines/baselines.h): a figure and a table.

#include "tuner_design/report/page/page.h"
#include "tuner_design/report/report_data.h"

namespace ehm::tuner_design::report {

void add_comparison(Section& section, const ReportData& data);

}  // namespace ehm::tuner_design::report
