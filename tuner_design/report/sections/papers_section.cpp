// SPDX-License-Identifier: Apache-2.0
// Tables 4 to 7 of Simon & Garg on this engine.

#include "tuner_design/report/sections/sections.h"
#include "tuner_design/report/study_sections/simon_garg_table_data.h"
#include "tuner_design/studies/simon_garg_table.h"

namespace ehm::tuner_design::report {

Section papers_section(const ReportData& data) {
  Section section{"papers", "The published study on this engine"};
  section.add_text("Simon & Garg, NASA/TM-2010-216077, tables 4 to 7. " + std::string(simon_garg_reading));
  for (const SimonGargStudy& study : data.studies.papers)
    section.add_table("simon-garg-" + std::to_string(study.options.table), study_title(study),
                      simon_garg_table_data(study));
  return section;
}

}  // namespace ehm::tuner_design::report
