// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/study_sections/lu_figures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/lu/published_beside.h"
#include "tuner_design/report/page/line_chart.h"

namespace ehm::tuner_design::report {
namespace {

/// A colour a component, fan, HPC, HPT, LPT; efficiencies are solid, flow capacities dashed.
struct Look {
  const char* name;
  int colour;
  Mark mark;
};
constexpr Look looks[lu_health_count] = {
    {"SE1, fan efficiency", 1, Mark::line}, {"SW1, fan flow", 1, Mark::dashed_line},
    {"SE2, HPC efficiency", 2, Mark::line}, {"SW2, HPC flow", 2, Mark::dashed_line},
    {"SE3, HPT efficiency", 3, Mark::line}, {"SW3, HPT flow", 3, Mark::dashed_line},
    {"SE4, LPT efficiency", 4, Mark::line}};

struct Figure {
  std::string id, title;
  std::vector<const LuCase*> panels;
};

/// Cases that are flown alike but for the filter.
bool same_flight(const LuCase& a, const LuCase& b) {
  return a.flight.fault == b.flight.fault && a.flight.noise == b.flight.noise &&
         a.flight.missing_sensor == b.flight.missing_sensor && a.flight.ratio_weights == b.flight.ratio_weights;
}

/// The paper's number of this figure; 0 where it has none.
int paper_number(int table, const LuFlight& flight) {
  const bool gaussian = flight.noise == NoiseDistribution::gaussian;
  if (flight.ratio_weights || flight.noise == NoiseDistribution::rayleigh) return 0;
  if (table == 4) return gaussian ? 2 + flight.fault : 0;
  if (table == 5) return gaussian ? 0 : 4 + flight.fault;
  if (table == 6) return gaussian ? 7 : 8;
  return 9;
}

std::vector<Figure> figures_of(const LuStudy& study) {
  const int table = study.options.table;
  if (table == 7 || table == 9) return {};
  std::vector<Figure> figures;
  for (const LuCase& c : study.cases) {
    // of table 8 the paper draws the last one alone, without P5
    if (table == 8 && c.flight.missing_sensor != lu_sensor_count - 1) continue;
    const auto known = std::find_if(figures.begin(), figures.end(),
                                    [&](const Figure& figure) { return same_flight(*figure.panels.front(), c); });
    if (known != figures.end()) {
      known->panels.push_back(&c);
      continue;
    }
    const int number = paper_number(table, c.flight);
    figures.push_back(
        {"lu-" + std::to_string(table) + "-estimates-" + std::to_string(figures.size() + 1),
         (number > 0 ? "The paper's figure " + std::to_string(number) + ": " : "Not in the paper: ") + c.what + ".",
         {&c}});
  }
  return figures;
}

/// Samples that are drawn: some 170 of a fault's 500, one a second of gradual wear.
int drawn_each(const LuCase& c) {
  return c.flight.fault == 0 ? 50 : 3;
}

double rounded(double percent) {
  return std::round(1e4 * percent) / 1e4;
}

struct Course {
  std::vector<double> time_s;
  std::array<std::vector<double>, lu_health_count> truth, estimate;
};

Course course_of(const LuCase& c) {
  Course course;
  for (std::size_t k = 0; k < c.first_estimates.size(); k += as_size(drawn_each(c))) {
    course.time_s.push_back(std::round(1e3 * lu_filter_step_s * static_cast<double>(k)) / 1e3);
    const LuHealth truth = lu_truth(c.flight.fault, static_cast<int>(k));
    for (std::size_t i = 0; i < lu_health_count; ++i) {
      course.truth[i].push_back(rounded(truth(as_index(i))));
      course.estimate[i].push_back(rounded(c.first_estimates[k](as_index(i))));
    }
  }
  return course;
}

LineChart panel_of(const LuCase& c, const std::string& id, const std::vector<double>& range) {
  const Course course = course_of(c);
  LineChart chart{.id = id,
                  .title = filter_name(c) + ", " + c.what,
                  .description = "Estimates of seven health parameters over time, their true values as grey lines.",
                  .x = {"time, s"},
                  .y = {"change of health, % of nominal", false, true, range},
                  .series = {},
                  .height_px = 250.0,
                  .heading = filter_name(c)};
  for (const auto& truth : course.truth) chart.series.push_back({"truth", course.time_s, truth, 6, Mark::line, true});
  for (std::size_t i = 0; i < lu_health_count; ++i)
    chart.series.push_back({looks[i].name, course.time_s, course.estimate[i], looks[i].colour, looks[i].mark, true});
  return chart;
}

DataTable numbers_of(const Figure& figure) {
  DataTable table{{"filter", "time [s]"}, {}};
  for (const char* name : lu_health_names) table.columns.push_back(std::string(name) + " estimate [%]");
  for (const char* name : lu_health_names) table.columns.push_back(std::string(name) + " truth [%]");
  for (const LuCase* c : figure.panels) {
    const Course course = course_of(*c);
    for (std::size_t k = 0; k < course.time_s.size(); ++k) {
      std::vector<Cell> row{filter_name(*c), course.time_s[k]};
      for (const auto& estimate : course.estimate) row.emplace_back(estimate[k]);
      for (const auto& truth : course.truth) row.emplace_back(truth[k]);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace

void add_lu_figures(Section& section, const LuStudy& study) {
  for (const Figure& figure : figures_of(study)) {
    std::vector<double> range;
    for (const LuCase* c : figure.panels)
      for (const LuHealth& estimate : c->first_estimates) range.insert(range.end(), estimate.begin(), estimate.end());
    const auto [low, high] = std::minmax_element(range.begin(), range.end());
    if (low != range.end()) range = {*low, *high};
    std::vector<LineChart> charts;
    for (const LuCase* c : figure.panels)
      charts.push_back(panel_of(*c, figure.id + "-" + std::to_string(charts.size() + 1), range));
    section.add_figure(
        figure.id, figure.title,
        "Ours, first run, a drawing a filter, all on one scale; every " +
            std::string(drawn_each(*figure.panels.front()) == 3 ? "third" : "fiftieth") +
            " sample. Colours are components, dashed lines their flow capacities. A filter follows where "
            "its lines lie on the grey ones; a line that stops has diverged.",
        panels(charts), numbers_of(figure));
  }
}

}  // namespace ehm::tuner_design::report
