// SPDX-License-Identifier: Apache-2.0
#pragma once
// A study in the layout of the paper's table: rows of tuners, theory above experiment, channels, SSEE at the right, in
// the paper's units (health percent^2; temperatures degR^2; thrust percent^2; margins points^2). The published table
// stands below as context.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/studies/simon_garg.h"

namespace ehm::tuner_design {

/// One line of the table: ours or theirs.
struct TableLine {
  std::string group, tuners;   ///< as in StudyRow
  std::string kind;            ///< "theory", "experiment", "standard error", "limit"
  std::string source;          ///< "ours" or "published, C-MAPSS"
  std::vector<double> values;  ///< channels, then SSEE
};

/// Ours first. The published lines are there only if the numbers of channels are equal.
std::vector<TableLine> table_lines(const SimonGargStudy& study);

/// "Table 4: ..."
std::string study_title(const SimonGargStudy& study);

std::vector<std::string> table_columns(const SimonGargStudy& study);

std::string study_csv(const SimonGargStudy& study);
nlohmann::ordered_json study_as_json(const SimonGargStudy& study);
void print_study(const SimonGargStudy& study, std::ostream& out);

}  // namespace ehm::tuner_design
