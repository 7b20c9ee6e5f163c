// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kosanam's tables in the thesis' layout, published numbers beside ours, for people, as CSV and as JSON with the same
// numbers. "Percent" of a table is of the change of health over the flights (*reading*); absolute percent stands below.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/kosanam/constrained_tables.h"
#include "tuner_design/kosanam/gain_search.h"
#include "tuner_design/kosanam/robust_tables.h"

namespace ehm::tuner_design {

void print_constrained_tables(const ConstrainedTables& tables, std::ostream& out);
nlohmann::ordered_json constrained_tables_as_json(const ConstrainedTables& tables);
/// A line for each factor of qh, filter and parameter.
std::string constrained_tables_csv(const ConstrainedTables& tables);

/// Table 5.2 or 5.3, and figure 5.6.
void print_robust_tables(const RobustTables& tables, std::ostream& out);
nlohmann::ordered_json robust_tables_as_json(const RobustTables& tables);
std::string robust_tables_csv(const RobustTables& tables);

void print_gain_search(const GainSearch& search, std::ostream& out);
nlohmann::ordered_json gain_search_as_json(const GainSearch& search);
std::string gain_search_csv(const GainSearch& search);

}  // namespace ehm::tuner_design
