// SPDX-License-Identifier: Apache-2.0
// The designs that fly when a sensor has failed.

#include <cmath>

#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/html_table.h"
#include "tuner_design/report/sections/sections.h"

namespace ehm::tuner_design::report {

Section missing_sensor_section(const ReportData& data) {
  const auto& design = data.design;
  Section section{"missing-sensors", "When a sensor fails"};
  BarChart chart{.id = "missing-sensor",
                 .title = "Error without one sensor",
                 .description = "Expected squared error of health without each sensor in turn.",
                 .categories = {},
                 .series = {{"squared error of health without this sensor", {}}},
                 .marks = {{"with all sensors", {}}, {"the fleet's own (prior)", {}, Mark::diamond, 6}},
                 .axis_title = "SSEE(h), percent²"};
  chart.marks[0].colour = 5;
  DataTable table{{"without sensor", "tuners", "SSEE(h) [percent²]", "SSEE(z) [mixed]", "slowest time constant [s]"},
                  {}};
  for (std::size_t i = 0; i < design.missing.size(); ++i) {
    const std::string& name = design.model.sensors[i].name;
    const auto& subset = design.missing[i];
    chart.categories.push_back(name);
    chart.series[0].values.push_back(subset ? subset->health_total_covariance.trace() : no_number);
    chart.marks[0].values.push_back(data.health.total.sum());
    chart.marks[1].values.push_back(data.health.prior.sum());
    if (subset) {
      table.rows.push_back({name, static_cast<double>(subset->V.rows()), subset->health_total_covariance.trace(),
                            subset->auxiliary_total_covariance.trace(), subset->slowest_time_constant_s});
    } else {
      table.rows.push_back({name, no_number, no_number, no_number, no_number});
    }
  }
  section.add_text(
      "For each sensor there is a design that does without it; the monitor changes over by itself. Errors include "
      "what the linear model misses. A sensor without a bar has no such design.");
  section.add_figure(chart.id, "How much each sensor is worth.",
                     "The longer the bar, the more is lost with that sensor; at the diamond nothing is known that "
                     "the fleet did not tell.",
                     responsive(chart) + html_table(table, "Designs without one sensor"), table);
  return section;
}

}  // namespace ehm::tuner_design::report
