// SPDX-License-Identifier: Apache-2.0
// V* in physical names, and the resolution that it gives.

#include "tuner_design/report/page/heat_map.h"
#include "tuner_design/report/sections/sections.h"

namespace ehm::tuner_design::report {

Section tuner_section(const ReportData& data) {
  Section section{"tuners", "The tuners"};
  const auto names = names_of(data.design.model.health);
  HeatMap tuners{"tuner-matrix",
                 "Tuner matrix V*",
                 "The tuner vector is q = V* h: one tuner a row, health parameters as columns, orthonormal rows.",
                 {},
                 names,
                 data.design.full.V,
                 "weight in q = V* h, h in percent",
                 1.0};
  for (Eigen::Index i = 0; i < tuners.values.rows(); ++i) tuners.rows.push_back("q" + std::to_string(i + 1));
  section.add_figure(tuners.id, "The tuner matrix V*.",
                     "Each row is one tuner, a weighted sum of health parameters. Only the space that the rows span "
                     "matters: any invertible mixture of them estimates the same.",
                     responsive(tuners), data_of(tuners, "tuner"));
  const HeatMap resolution{"resolution",
                           "Resolution of the estimate",
                           "Settled estimate of each health parameter (rows) for a change of one percent of each "
                           "true health parameter (columns).",
                           names,
                           names,
                           data.settled * data.model.health_sigma.cwiseInverse().asDiagonal(),
                           "percent estimated per percent true",
                           1.0};
  section.add_figure(resolution.id, "What becomes of a change of one parameter.",
                     "A column is a true change of 1 %, the rows are what the filter makes of it once settled. A "
                     "blue diagonal of ones and nothing else would be perfect sight; entries off the diagonal are "
                     "what is taken for another parameter.",
                     responsive(resolution), data_of(resolution, "estimate"));
  return section;
}

}  // namespace ehm::tuner_design::report
