// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/study_sections/study_page.h"

#include <utility>

namespace ehm::tuner_design::report {

Page study_page(Section section, const StudyOrigin& origin) {
  Page page;
  page.kind = "Study";
  page.title = section.title;
  page.subtitle = origin.command;
  Section made{"origin", "How this page was made"};
  made.add_table("origin-facts", "The same command and seed give the same numbers on any number of threads",
                 {{"item", "is"},
                  {{"Command", origin.command},
                   {"Seed", std::to_string(origin.seed)},
                   {"Program", "tuner_design " + origin.version}}});
  page.sections = {std::move(section), std::move(made)};
  page.footer = "Made by tuner_design " + origin.version +
                ". What the studies are, and what was found: the project's "
                "deploy/docs/studies.md.";
  return page;
}

}  // namespace ehm::tuner_design::report
