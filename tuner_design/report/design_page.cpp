// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/design_page.h"

#include "tuner_design/print/design_text.h"
#include "tuner_design/report/sections/sections.h"

namespace ehm::tuner_design::report {

Page design_page(const design::Design& design, const Studies& studies) {
  const ReportData data = report_data(design, studies);
  Page page;
  page.title = design.model.name;
  page.subtitle = "Design " + design.hash.substr(0, 12) + ", " + reduction(design);
  page.sections = {summary_section(data),    accuracy_section(data),       optimum_section(data),
                   tuner_section(data),      observability_section(data),  response_section(data),
                   evaluation_section(data), missing_sensor_section(data), origin_section(data)};
  if (!data.studies.papers.empty()) page.sections.insert(page.sections.end() - 2, papers_section(data));
  page.footer = "Made by " + design.options.created_by + " " + design.options.version + " from the design with hash " +
                design.hash +
                ". Equations: Simon & Garg, NASA/TM-2010-216077; error theory and limits as in the project's "
                "deploy/docs/theory.md.";
  return page;
}

}  // namespace ehm::tuner_design::report
