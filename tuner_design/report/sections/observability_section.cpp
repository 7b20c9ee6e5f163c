// SPDX-License-Identifier: Apache-2.0
// Which combinations of health parameters the sensors see: the singular values and right singular vectors of
// R^-1/2 H Ph^1/2 (observability.h).

#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/design/detectability.h"
#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/heat_map.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/sections/sections.h"
#include "tuner_design/theory/observability.h"

namespace ehm::tuner_design::report {
namespace {

struct Directions {
  Eigen::VectorXd strength;    ///< min(m, p), descending: signal to noise of one sample
  Eigen::MatrixXd components;  ///< p x p, a direction a row; the largest entry of each is positive
  Eigen::Index seen = 0;       ///< rows above the numerical rank
};

Directions directions_of(const ReportData& data) {
  const Eigen::MatrixXd Hs =
      data.model.sensor_noise_sigma.cwiseInverse().asDiagonal() * data.steady.H * data.model.health_sigma.asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Hs, Eigen::ComputeFullV);
  Directions directions{svd.singularValues(), svd.matrixV().transpose(), 0};
  for (Eigen::Index i = 0; i < directions.components.rows(); ++i) {
    Eigen::Index largest = 0;
    directions.components.row(i).cwiseAbs().maxCoeff(&largest);
    if (directions.components(i, largest) < 0.0) directions.components.row(i) *= -1.0;
  }
  directions.seen = steady_observability(data.model, data.steady.H).rank;
  return directions;
}

std::string direction_name(const Directions& directions, Eigen::Index i) {
  return std::to_string(i + 1) + (i < directions.seen ? "" : " (unseen)");
}

BarChart strength_chart(const Directions& directions) {
  BarChart chart{.id = "singular-values",
                 .title = "What the sensors see of health",
                 .description =
                     "Singular values of the steady sensitivity in units of sensor noise and of the fleet's spread, "
                     "on a logarithmic axis.",
                 .categories = {},
                 .series = {{"signal to noise of one sample", {}}},
                 .marks = {{"as strong as the noise", {}}},
                 .axis_title = "signal to noise ratio of one sample (logarithmic)",
                 .logarithmic = true};
  for (Eigen::Index i = 0; i < directions.seen; ++i) {
    chart.categories.push_back("combination " + direction_name(directions, i));
    chart.series[0].values.push_back(directions.strength(i));
    chart.marks[0].values.push_back(1.0);
  }
  return chart;
}

DataTable strength_table(const Directions& directions, double sample_time_s) {
  DataTable table{{"combination", "signal to noise of one sample", "averaging until both are equal [s]"}, {}};
  for (Eigen::Index i = 0; i < directions.seen; ++i) {
    const double s = directions.strength(i);
    table.rows.push_back({std::to_string(i + 1), s, sample_time_s / (s * s)});
  }
  return table;
}

DataTable detectability_table(const ReportData& data) {
  DataTable table{{"sensor", "distance of a slow bias of 5 sigma"}, {}};
  const Eigen::VectorXd detectability =
      design::slow_bias_detectability(data.design.model, data.design.scaling, data.design.full);
  for (Eigen::Index i = 0; i < detectability.size(); ++i)
    table.rows.push_back({data.design.model.sensors[as_size(i)].name, detectability(i)});
  return table;
}

}  // namespace

Section observability_section(const ReportData& data) {
  const Directions directions = directions_of(data);
  Section section{"observability", "What the sensors see"};
  const Eigen::Index p = data.steady.H.cols(), unseen = p - directions.seen;
  section.add_text(
      "Health changes the sensors in combinations. Ordered from the strongest to the weakest, and in units of the "
      "sensors' noise and of the fleet's spread, there are " +
      std::to_string(directions.seen) + " of them" +
      (unseen > 0 ? "; in " + std::to_string(unseen) + (unseen == 1 ? " further direction" : " further directions") +
                        " health can change without any sensor noticing. That part is the Bayes limit."
                  : ", one for each health parameter: nothing is hidden."));
  const BarChart chart = strength_chart(directions);
  section.add_figure(
      chart.id, "How strongly each combination shows.",
      "A combination below the stroke at 1 is weaker than the noise of one sample and has to be averaged: N samples "
      "gain a factor of √N.",
      responsive(chart), strength_table(directions, data.model.sample_time_s));
  HeatMap map{"directions",
              "Combinations of health parameters",
              "Right singular vectors of the scaled sensitivity: one combination a row, health parameters as columns.",
              {},
              names_of(data.design.model.health),
              directions.components,
              "weight, in units of the fleet's spread",
              1.0};
  for (Eigen::Index i = 0; i < p; ++i) map.rows.push_back(direction_name(directions, i));
  section.add_figure(map.id, "Which combinations these are.",
                     "A row is one combination; a strong colour in one column alone means that the sensors see that "
                     "parameter by itself. Blue and orange in a row move against each other.",
                     responsive(map), data_of(map, "combination"));
  section.add_table("slow-bias",
                    "A sensor that drifts away slowly looks like an engine that wears. The distance says how far from "
                    "the fleet's wear a drift of five noise sigmas leads, in standard deviations; the monitor watches "
                    "for slow bias where it is above 5.",
                    detectability_table(data));
  return section;
}

}  // namespace ehm::tuner_design::report
