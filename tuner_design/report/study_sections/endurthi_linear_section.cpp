// SPDX-License-Identifier: Apache-2.0
// Endurthi's tables I to III and figures 5.1 and 5.2: 27 linear models against the nonlinear engine.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/endurthi/best_models.h"
#include "tuner_design/endurthi/published.h"
#include "tuner_design/report/page/line_chart.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design::report {
namespace {

using namespace endurthi;

std::string percent(double value) {
  return fmt::format("{:g} %", value);
}

/// Tables I and II: the best of the 27 in each cell, beside what the thesis has there.
DataTable best_table(const LinearisationStudy& study, int table) {
  const ErrorPart part = table == 1 ? &ModelError::average : &ModelError::final;
  const std::size_t theirs = table == 1 ? published_average_model : published_final_model;
  DataTable rows{{"point", "linearised with", "tested with", "published best", "best of ours", "its error",
                  "error of " + model_name(theirs), "error of the tangent"},
                 {}};
  for (const LinearisationPoint& point : study.points) {
    const bool first = &point == study.points.data();
    for (std::size_t k = 0; k < studied_percents.size(); ++k) {
      for (std::size_t test = 0; test < studied_percents.size(); ++test) {
        const ModelErrors& errors = point.errors[k][test];
        const std::size_t best = best_of(errors, part);
        rows.rows.push_back({point.name, percent(studied_percents[k]), percent(studied_percents[test]),
                             first ? published_best(table, k, test) : "–", model_name(best), errors[best].*part,
                             errors[theirs].*part, errors[tangent_model].*part});
      }
    }
  }
  return rows;
}

/// Table III, and the same on maps with a corner; x 1e-4.
DataTable all_models(const LinearisationStudy& study) {
  DataTable table{{"model", "published, average [1e-4]", "published, final [1e-4]"}, {}};
  for (const LinearisationPoint& point : study.points)
    for (const char* what : {"average", "final", "average on maps with a corner", "final on maps with a corner"})
      table.columns.push_back(point.name + ": " + what + " [1e-4]");
  for (std::size_t model = 0; model <= model_count; ++model) {
    const bool known = model < model_count;
    std::vector<Cell> row{model_name(model), known ? published_models[model].average_1e4 : no_number,
                          known ? published_models[model].final_1e4 : no_number};
    for (const LinearisationPoint& point : study.points) {
      const ModelError &plain = point.errors[0][0][model], &corner = point.with_corner[model];
      for (const double error : {plain.average, plain.final, corner.average, corner.final})
        row.emplace_back(1e4 * error);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Figure 5.1: a point a model, in the order of their digits; the last one is the tangent.
LineChart models_chart(const LinearisationPoint& point, std::size_t number, const std::vector<double>& range) {
  LineChart chart{.id = "endurthi-1-models-" + std::to_string(number),
                  .title = "Error of 27 linear models, " + point.name,
                  .description =
                      "Average error of each linear model and of the tangent: ours, ours on maps with a corner, "
                      "and as published.",
                  .x = {"model: 1 is LIN000, 27 is LIN222, 28 the tangent"},
                  .y = {"average error over perturbation, 1e-4", true, false, range},
                  .series = {{"ours, smooth maps", {}, {}, 1, Mark::circle},
                             {"ours, maps with a corner", {}, {}, 3, Mark::circle},
                             {"published (MAPSS, first point)", {}, {}, 2, Mark::circle}},
                  .height_px = 280.0,
                  .heading = point.name};
  for (std::size_t model = 0; model <= model_count; ++model) {
    const auto add = [&](LineSeries& series, double error) {
      series.x.push_back(static_cast<double>(model + 1));
      series.y.push_back(error);
    };
    add(chart.series[0], 1e4 * point.errors[0][0][model].average);
    add(chart.series[1], 1e4 * point.with_corner[model].average);
    if (number == 1 && model < model_count) add(chart.series[2], published_models[model].average_1e4);
  }
  return chart;
}

void add_models(Section& section, const LinearisationStudy& study) {
  std::vector<double> range;
  for (const PublishedModel& model : published_models) range.push_back(model.average_1e4);
  for (const LinearisationPoint& point : study.points)
    for (const ModelErrors* errors : {&point.errors[0][0], &point.with_corner})
      for (const ModelError& error : *errors) range.push_back(1e4 * error.average);
  std::vector<LineChart> charts;
  for (const LinearisationPoint& point : study.points) charts.push_back(models_chart(point, charts.size() + 1, range));
  section.add_figure(
      "endurthi-1-models", "The thesis' figure 5.1: error of the 27 models.",
      "In the thesis every second of three (LINxy1, Matlab's method for health) stands out. On smooth maps "
      "none of ours does; on maps with a corner, which its step does not reach, they do. Linearised and "
      "tested with 0.01 %.",
      panels(charts), all_models(study));
}

constexpr std::array traced_sensors{"Nc", "T30", "P24", "T50"};

void add_traces(Section& section, const LinearisationPoint& point, std::size_t number) {
  const LinearisationTrace& trace = point.trace;
  const std::string id = "endurthi-1-trace-" + std::to_string(number);
  std::vector<LineChart> charts;
  DataTable table{{"sensor", "time [s]", "nonlinear [% of trim]", "LIN002 [% of trim]", "tangent [% of trim]"}, {}};
  for (std::size_t i = 0; i < trace.sensors.size(); ++i) {
    const std::string& sensor = trace.sensors[i];
    if (std::find(traced_sensors.begin(), traced_sensors.end(), sensor) == traced_sensors.end()) continue;
    LineChart chart{.id = id + "-" + sensor,
                    .title = sensor + ", " + point.name,
                    .description = "Change of " + sensor + " of the nonlinear engine and of two linear models.",
                    .x = {"time, s"},
                    .y = {"change, % of trim"},
                    .series = {{"nonlinear engine", {}, {}, 6},
                               {"LIN002", {}, {}, 2, Mark::dashed_line},
                               {"tangent", {}, {}, 1, Mark::dashed_line}},
                    .height_px = 200.0,
                    .heading = sensor};
    const std::array answers{&trace.nonlinear, &trace.model, &trace.tangent};
    for (Eigen::Index k = 0; k < trace.nonlinear.cols(); ++k) {
      const double t = trace.step_s * static_cast<double>(k);
      std::vector<Cell> row{sensor, t};
      for (std::size_t s = 0; s < answers.size(); ++s) {
        chart.series[s].x.push_back(t);
        chart.series[s].y.push_back((*answers[s])(as_index(i), k));
        row.emplace_back(chart.series[s].y.back());
      }
      table.rows.push_back(std::move(row));
    }
    charts.push_back(std::move(chart));
  }
  section.add_figure(id, "The thesis' figure 5.2: linear against nonlinear, " + point.name + ".",
                     "States and health are 0.5 % lower at time 0, and the engine's own control acts. LIN002 was made "
                     "with steps of 0.01 %. Where the lines are one, the model is good.",
                     panels(charts), std::move(table));
}

/// How many of the 27 are different models at all.
DataTable groups_table(const LinearisationStudy& study) {
  DataTable table{{"point", "linearised with", "models that differ by more than 1e-3 of a column"}, {}};
  for (const LinearisationPoint& point : study.points)
    for (std::size_t k = 0; k < studied_percents.size(); ++k)
      table.rows.push_back({point.name, percent(studied_percents[k]), static_cast<double>(point.groups[k].size())});
  return table;
}

/// What a model misses in its worst cell, over the best model there.
DataTable worst_table(const LinearisationStudy& study) {
  DataTable table{{"point", "table", "the least of all", "its worst cell", "the tangent's",
                   "LIN212's, best in the thesis' table I", "LIN022's, best in its table II"},
                  {}};
  for (const LinearisationPoint& point : study.points) {
    for (const auto& [name, part] : {std::pair{"I", &ModelError::average}, std::pair{"II", &ModelError::final}}) {
      const std::size_t safest = safest_of(point, part);
      table.rows.push_back({point.name, name, model_name(safest), worst_ratio(point, safest, part),
                            worst_ratio(point, tangent_model, part), worst_ratio(point, published_average_model, part),
                            worst_ratio(point, published_final_model, part)});
    }
  }
  return table;
}

}  // namespace

Section linearisation_section(const LinearisationStudy& study) {
  Section section{"endurthi-1", "Endurthi, tables I to III: 27 linear models"};
  section.add_text(
      "On " + study.options.engine->data.name +
      ", smooth maps, 3 states, 3 controls, 9 health parameters, 11 sensors; the thesis has MAPSS, a "
      "mixed-flow military engine whose tables have corners: its numbers are context, no target. LINxyz: "
      "columns of the states by method x, of the controls by y, of health by z; 0 perturbation, 1 Matlab's "
      "linmod, 2 steady state. Errors: percent of trim per percent of perturbation, RMS over the sensors.");
  add_models(section, study);
  for (std::size_t i = 0; i < study.points.size(); ++i) add_traces(section, study.points[i], i + 1);
  section.add_table("endurthi-1-worst",
                    "Error in a model's worst cell, over that of the best model there: what it costs not to know how "
                    "large the change will be",
                    worst_table(study));
  section.add_table("endurthi-1-groups",
                    "On smooth maps models coincide, and which is best is decided by the steps alone",
                    groups_table(study));
  section.add_table("endurthi-1-table", "Table I: the best of 27 linear models, error averaged over 6 s",
                    best_table(study, 1));
  section.add_table("endurthi-2-table", "Table II: the best of 27 linear models, error after 6 s",
                    best_table(study, 2));
  section.add_table("endurthi-3-table", "Table III: all models, linearised and tested with 0.01 %", all_models(study));
  return section;
}

}  // namespace ehm::tuner_design::report
