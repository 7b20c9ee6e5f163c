// SPDX-License-Identifier: Apache-2.0
// Kosanam's tables 5.2 and 5.3 and figures 5.4 to 5.6: a gain that does not trust the noise of the model.

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/kosanam/robust_tables.h"
#include "tuner_design/report/page/line_chart.h"
#include "tuner_design/report/page/score_matrix.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/study_sections/kosanam_set_up.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design::report {
namespace {

using Published = std::array<std::array<double, 2>, 8>;
constexpr double wrong_noise = 9.0, nominal_noise = 1.0;

DataTable table_of(const RobustTables& t, double noise, const Published& published,
                   const std::array<double, 2>& average) {
  using namespace robust_case;
  const BatchResult& r = t.at(noise);
  DataTable table{{"health parameter", "published, standard [% of change]", "published, robust [% of change]",
                   "published ratio", "ours, standard [% of change]", "ours, mixed [% of change]", "mixed ratio",
                   "ours, robust [% of change]", "robust ratio"},
                  {}};
  const auto add = [&](const std::string& name, const std::array<double, 2>& theirs, double ours, double by_mixed,
                       double by_robust) {
    table.rows.push_back({name, theirs[0], theirs[1], theirs[1] / theirs[0], ours, by_mixed, by_mixed / ours, by_robust,
                          by_robust / ours});
  };
  const bool known = t.health.size() == published.size();
  for (std::size_t i = 0; i < t.health.size(); ++i)
    add(t.health[i], known ? published[i] : std::array{no_number, no_number}, r.of_change(standard, as_index(i)),
        r.of_change(mixed, as_index(i)), r.of_change(robust, as_index(i)));
  add("average", average, r.of_change(standard), r.of_change(mixed), r.of_change(robust));
  return table;
}

/// Figure 5.6, in percent of change, so that the averages of the tables are points of it.
LineChart noise_chart(const RobustTables& t) {
  using namespace robust_case;
  LineChart chart{.id = "kosanam-5-2-noise-chart",
                  .title = "Error over the sensors' true variance",
                  .description =
                      "Average error of the standard, the mixed and the robust filter over the factor by which "
                      "the sensors' variance is larger than the model says.",
                  .x = {"variance of the sensors over the model's", true},
                  .y = {"average RMS error, % of the true change", true},
                  .series = {}};
  constexpr std::array names{"ours, standard", "ours, mixed", "ours, robust"};
  constexpr std::array colours{6, 3, 1};
  for (const Case f : {standard, mixed, robust}) {
    LineSeries line{names[f], t.options.noise_factors, {}, colours[f], f == standard ? Mark::dashed_line : Mark::line};
    for (const BatchResult& result : t.by_noise) line.y.push_back(result.of_change(f));
    chart.series.push_back(std::move(line));
  }
  const std::vector<double> at{nominal_noise, wrong_noise};
  chart.series.push_back(
      {"published, standard", at, {published_5_3_average[0], published_5_2_average[0]}, 5, Mark::circle});
  chart.series.push_back(
      {"published, robust (mixed)", at, {published_5_3_average[1], published_5_2_average[1]}, 2, Mark::circle});
  return chart;
}

/// J of the gain for R x mu: in place of the thesis' iterations.
LineChart objective_chart(const RobustTables& t) {
  LineChart chart{.id = "kosanam-5-2-objective-chart",
                  .title = "J over the doubt in the sensors",
                  .description = "The robust objective of the Kalman gain for R times mu, over mu.",
                  .x = {"mu: the gain is the Kalman gain for R × mu", true},
                  .y = {"J over that of the standard gain, %", false, true},
                  .series = {}};
  LineSeries line{"Kalman gains for R × mu", {}, {}, 1};
  for (const RobustTrade& point : t.trade) {
    line.x.push_back(point.mu);
    line.y.push_back(100.0 * (point.process + point.sensor + t.options.rho2 * point.sensor * point.sensor) /
                     t.standard_objective);
  }
  chart.series = {line, {"the optimum", {t.mu}, {100.0 * t.robust_objective / t.standard_objective}, 2, Mark::circle}};
  return chart;
}

ScoreMatrix surface_chart(const RobustTables& t) {
  const ObjectiveSurface& s = t.surface;
  ScoreMatrix matrix{.id = "kosanam-5-2-surface-chart",
                     .title = "J over two elements of the gain",
                     .description =
                         "The robust objective over that of the standard gain, for two elements of the gain "
                         "between minus one and three times their standard values.",
                     .rows = {},
                     .columns = {},
                     .values = s.objective,
                     .marked = {},
                     .scale_title = "J over that of the standard gain",
                     .full_scale = 3.0};
  for (const double share : s.share) {
    matrix.rows.push_back(number(share, 2) + " ×");
    matrix.columns.push_back(number(share, 2) + " ×");
  }
  return matrix;
}

DataTable surface_numbers(const RobustTables& t) {
  const ObjectiveSurface& s = t.surface;
  DataTable table{{"share of the first element", "share of the second element", "J over standard"}, {}};
  for (std::size_t i = 0; i < s.share.size(); ++i)
    for (std::size_t j = 0; j < s.share.size(); ++j)
      table.rows.push_back({s.share[i], s.share[j], s.objective(as_index(i), as_index(j))});
  return table;
}

std::string gain_text(const RobustTables& t) {
  return "The robust gain is the Kalman gain for R × " + number(t.mu, 4) +
         ", the optimum of J for rho2/rho1 = " + number(t.options.rho2) + " a percent²; J changes by " +
         number(100.0 * (t.robust_objective / t.standard_objective - 1.0), 2) + " % (thesis: −80 %). Mixed is " +
         number(t.options.eta) + " of the standard gain and " + number(1.0 - t.options.eta) +
         " of the robust one, as the thesis had to: its own was unstable.";
}

}  // namespace

Section robust_tables_section(const RobustTables& t) {
  Section section{"kosanam-5-2", "Kosanam, tables 5.2 and 5.3: noise that is not the model's"};
  section.add_text(kosanam_set_up(t.model, t.options.batch, t.options.health_variance * t.factor, t.not_known));
  section.add_text(gain_text(t));
  section.add_table("kosanam-5-2-table", "Table 5.2: the sensors' variance is nine times the model's",
                    table_of(t, wrong_noise, published_5_2, published_5_2_average), 1);
  section.add_table("kosanam-5-3-table", "Table 5.3: the noise is the model's",
                    table_of(t, nominal_noise, published_5_3, published_5_3_average), 1);
  const LineChart objective = objective_chart(t), noise = noise_chart(t);
  section.add_figure("kosanam-5-4", "The thesis' figure 5.4: the objective falls.",
                     "The thesis draws J over 96 hours of a descent that did not end. Here the optimum is one point of "
                     "one curve, in closed form.",
                     responsive(objective), data_of(objective));
  const ObjectiveSurface& s = t.surface;
  section.add_figure("kosanam-5-5", "The thesis' figure 5.5: J over two elements of the gain.",
                     "Down: the element for sensor " + t.sensors[as_size(s.first)] + ", across: that for " +
                         t.sensors[as_size(s.second)] + ", both in the row of " + t.health[as_size(s.parameter)] +
                         ", as multiples of their standard values. Orange is worse than the standard gain, "
                         "blue better; where there is no number the filter is unstable.",
                     responsive(surface_chart(t)), surface_numbers(t));
  section.add_figure(
      "kosanam-5-6", "The thesis' figure 5.6: error over the change of noise.",
      "The robust filter pays from where its line falls below the dashed one. Points are the averages of "
      "the published tables.",
      responsive(noise), data_of(noise));
  return section;
}

}  // namespace ehm::tuner_design::report
