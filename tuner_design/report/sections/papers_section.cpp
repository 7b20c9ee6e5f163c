// SPDX-License-Identifier: Apache-2.0
// Tables 4 to 7 of Simon & Garg on this engine.

#include "tuner_design/report/page/html_table.h"
#include "tuner_design/report/sections/sections.h"
#include "tuner_design/studies/simon_garg_table.h"

namespace ehm::tuner_design::report {
namespace {

DataTable data_of(const SimonGargStudy& study) {
  DataTable table{{"tuners", "row", "what"}, {}};
  for (const std::string& column : table_columns(study)) table.columns.push_back(column);
  for (const TableLine& line : table_lines(study)) {
    const bool lettered = line.tuners.size() == 1, ours = line.source == "ours";
    std::vector<Cell> row{ours ? line.group : line.source + (lettered ? "" : ": " + line.tuners),
                          lettered ? line.tuners : "", line.kind};
    row.insert(row.end(), line.values.begin(), line.values.end());
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

Section papers_section(const ReportData& data) {
  Section section{"papers", "The published study on this engine"};
  section.add_text(
      "Simon & Garg, NASA/TM-2010-216077, tables 4 to 7. Rows a to d are tuners searched for the least MAP error of "
      "health, e to h for that of the auxiliary outputs, each from its own random start. Their engine is C-MAPSS, not "
      "this one: the published numbers are context, no target.");
  for (const SimonGargStudy& study : data.studies.papers)
    section.add_table("simon-garg-" + std::to_string(study.options.table), study_title(study), data_of(study));
  return section;
}

}  // namespace ehm::tuner_design::report
