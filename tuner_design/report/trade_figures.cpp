// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/trade_figures.h"

#include "tuner_design/report/page/line_chart.h"

namespace ehm::tuner_design::report {
namespace {

constexpr const char* time_title = "slowest time constant, s";

LineSeries over_time(const std::vector<ResponsePoint>& trade, const std::string& name, int colour, const auto& value,
                     Mark mark = Mark::line) {
  LineSeries line{name, {}, {}, colour, mark};
  for (const ResponsePoint& point : trade) {
    line.x.push_back(point.time_constant_s);
    line.y.push_back(value(point));
  }
  return line;
}

/// Bias, noise and their sum; `limit` as a level.
LineChart parts_chart(const ReportData& data, bool health) {
  const std::vector<ResponsePoint>& trade = data.studies.trade;
  LineChart chart{.id = health ? "trade-health" : "trade-auxiliary",
                  .title = health ? "Response time against accuracy of health"
                                  : "Response time against accuracy of the auxiliary outputs",
                  .description = "Squared error over the slowest time constant: bias, noise and their sum.",
                  .x = {time_title, true},
                  .y = {health ? "SSEE(h), percent²" : "SSEE(z), mixed units", false, true},
                  .series = {},
                  .height_px = 290.0,
                  .heading = health ? "Health" : "Auxiliary outputs"};
  const auto bias = [&](const ResponsePoint& p) { return health ? p.health_bias : p.auxiliary_bias; };
  const auto noise = [&](const ResponsePoint& p) { return health ? p.health_noise : p.auxiliary_noise; };
  chart.series.push_back(over_time(trade, "bias: unseen by the sensors", 2, bias));
  chart.series.push_back(over_time(trade, "noise", 3, noise));
  chart.series.push_back(over_time(trade, "SSEE, the sum", 1, [&](const auto& p) { return bias(p) + noise(p); }));
  const double limit = health ? data.health.limit.sum() : data.auxiliary.limit.sum();
  chart.series.push_back(over_time(
      trade, "Bayes limit", 5, [&](const auto&) { return limit; }, Mark::dashed_line));
  const auto& ssee = health ? data.design.ssee.health : data.design.ssee.auxiliary;
  chart.series.push_back({"this design", {data.design.full.slowest_time_constant_s}, {ssee.sum()}, 6, Mark::circle});
  return chart;
}

DataTable trade_table(const std::vector<ResponsePoint>& trade) {
  DataTable table{{"Qh [percent²]", "slowest time constant [s]", "bias(h) [percent²]", "noise(h) [percent²]",
                   "SSEE(h) [percent²]", "SSEE(h) of H Ph [percent²]", "bias(z) [mixed]", "noise(z) [mixed]",
                   "SSEE(z) [mixed]", "SSEE(z) of H Ph [mixed]", "J"},
                  {}};
  for (const ResponsePoint& p : trade) {
    table.rows.push_back({p.qh_percent2, p.time_constant_s, p.health_bias, p.health_noise, p.health(),
                          p.closed_form_health, p.auxiliary_bias, p.auxiliary_noise, p.auxiliary(),
                          p.closed_form_auxiliary, p.objective});
  }
  return table;
}

}  // namespace

void add_trade_figures(Section& section, const ReportData& data) {
  if (data.studies.trade.empty()) return;
  std::vector<LineChart> charts{parts_chart(data, true)};
  if (!data.design.model.auxiliary.empty()) charts.push_back(parts_chart(data, false));
  section.add_figure(
      "trade", "Response time against accuracy (Pareto curve).",
      "Each point of a line is a design with its own Qh and its own tuners; to the left the filter answers faster "
      "and scatters more. The blue line cannot pass the dashed one, and a design above the blue line gives accuracy "
      "away.",
      panels(charts), trade_table(data.studies.trade));
}

}  // namespace ehm::tuner_design::report
