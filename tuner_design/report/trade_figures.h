// SPDX-License-Identifier: Apache-2.0
#pragma once
// Response time against accuracy as figures: how far above the limit, and bias and noise apart.

#include "tuner_design/report/page/page.h"
#include "tuner_design/report/report_data.h"

namespace ehm::tuner_design::report {

/// Adds nothing if the trade was not computed.
void add_trade_figures(Section& section, const ReportData& data);

}  // namespace ehm::tuner_design::report
