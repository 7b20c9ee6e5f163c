// SPDX-License-Identifier: Apache-2.0
#pragma once
// A DataTable as an HTML table: numbers right-aligned with the same number of decimals down a column, so that they can
// be compared at a glance; what would vanish at that is written with a power of ten. A column "value" holds unlike
// quantities, each with its own decimals. Errors: none.

#include <string>

#include "tuner_design/report/page/data_table.h"

namespace ehm::tuner_design::report {

/// A column "sigma [K]" gets the unit on a line of its own. `totals` rows at the end stand below a rule.
std::string html_table(const DataTable& table, const std::string& caption, std::size_t totals = 0);

}  // namespace ehm::tuner_design::report
