// SPDX-License-Identifier: Apache-2.0
// How the filter answers a step of one sigma in each health parameter.

#include <algorithm>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/report/page/line_chart.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/sections/sections.h"
#include "tuner_design/report/step_response.h"
#include "tuner_design/report/trade_figures.h"

namespace ehm::tuner_design::report {
namespace {

constexpr int points = 80;

std::vector<double> estimates(const StepResponse& response, Eigen::Index estimated, Eigen::Index stepped) {
  std::vector<double> values;
  for (const Eigen::MatrixXd& estimate : response.estimate) values.push_back(estimate(estimated, stepped));
  return values;
}

LineChart step_chart(const ReportData& data, const StepResponse& response, Eigen::Index stepped,
                     const std::vector<double>& range) {
  const auto& health = data.design.model.health;
  const std::string& name = health[as_size(stepped)].name;
  LineChart chart{.id = "step-" + std::to_string(stepped + 1),
                  .title = "Step of one sigma in " + name,
                  .description = "Estimates of all health parameters over time after " + name + " changed by " +
                                 number(data.model.health_sigma(stepped)) + " percent.",
                  .x = {"time after the step, s"},
                  .y = {"percent", false, true, range},
                  .series = {},
                  .height_px = 200.0,
                  .heading = name};
  for (Eigen::Index i = 0; i < data.settled.rows(); ++i) {
    if (i == stepped) continue;
    chart.series.push_back(
        {"estimates of the others", response.time_s, estimates(response, i, stepped), 2, Mark::line, true});
  }
  chart.series.push_back(
      {"estimate of the parameter that changed", response.time_s, estimates(response, stepped, stepped), 1});
  const double sigma = data.model.health_sigma(stepped);
  chart.series.push_back({"true change, one sigma of the fleet",
                          {response.time_s.front(), response.time_s.back()},
                          {sigma, sigma},
                          6,
                          Mark::dashed_line});
  return chart;
}

DataTable step_table(const ReportData& data, const StepResponse& response) {
  DataTable table{{"changed parameter", "time [s]"}, {}};
  const auto names = names_of(data.design.model.health);
  for (const std::string& name : names) table.columns.push_back("estimate of " + name + " [percent]");
  for (std::size_t j = 0; j < names.size(); ++j) {
    for (std::size_t k = 0; k < response.time_s.size(); ++k) {
      std::vector<Cell> row{names[j], response.time_s[k]};
      for (std::size_t i = 0; i < names.size(); ++i) row.emplace_back(response.estimate[k](as_index(i), as_index(j)));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace

Section response_section(const ReportData& data) {
  Section section{"response", "Response in time"};
  const StepResponse response = step_response(data.design.full, data.model, points);
  std::vector<double> range{data.model.health_sigma.maxCoeff()};
  for (const Eigen::MatrixXd& estimate : response.estimate)
    range.insert(range.end(), {estimate.minCoeff(), estimate.maxCoeff()});
  std::vector<LineChart> charts;
  for (Eigen::Index j = 0; j < data.settled.cols(); ++j) charts.push_back(step_chart(data, response, j, range));
  section.add_figure(
      "step-response", "The filter after a step of one sigma in one health parameter.",
      "Each drawing is one experiment on the linear engine without noise, its name is the parameter that changes at "
      "time 0. The blue line would reach the dashed one if the sensors could see that parameter alone; thin lines "
      "are what the filter takes for changes of the other parameters.",
      panels(charts), step_table(data, response));
  add_trade_figures(section, data);
  return section;
}

}  // namespace ehm::tuner_design::report
