// SPDX-License-Identifier: Apache-2.0
#pragma once
// Figures 3 to 9 of Lu, Huang & Lv: estimates of health over time, a panel a filter, the truth behind. Of the first
// run; all panels of a figure have one scale. Errors: none.

#include "tuner_design/lu/lu_study.h"
#include "tuner_design/report/page/page.h"

namespace ehm::tuner_design::report {

/// Those of the study's table; adds nothing for tables 7 and 9, which have none.
void add_lu_figures(Section& section, const LuStudy& study);

}  // namespace ehm::tuner_design::report
