// SPDX-License-Identifier: Apache-2.0
// Endurthi's tables IV and V and figures 5.3 to 5.5: health by two filters on 27 linear models.

#include <fmt/format.h>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/endurthi/best_models.h"
#include "tuner_design/endurthi/health_study.h"
#include "tuner_design/endurthi/published.h"
#include "tuner_design/report/page/line_chart.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design::report {
namespace {

using namespace endurthi;

constexpr std::size_t drawn_each = 4;  ///< flights

const PublishedHealth& published_of(std::size_t model, FilterKind kind) {
  return kind == FilterKind::unconstrained ? published_models[model].unconstrained
                                           : published_models[model].constrained;
}

const HealthErrors& errors_of(const ModelHealth& model, FilterKind kind) {
  return model.by_kind[as_size(static_cast<int>(kind))];
}

/// Table IV or V: all models at both points; of the first point what was published below.
DataTable models_table(const HealthStudy& study, FilterKind kind) {
  DataTable table{{"point", "model"}, {}};
  for (const std::string& name : study.points.front().health) table.columns.push_back(name + " [% of change]");
  table.columns.insert(table.columns.end(), {"average [% of change]", "average [% of nominal]"});
  for (const HealthPoint& point : study.points) {
    for (std::size_t i = 0; i < point.models.size(); ++i) {
      const HealthErrors& errors = errors_of(point.models[i], kind);
      std::vector<Cell> row{point.name, model_name(i)};
      row.insert(row.end(), errors.of_change.begin(), errors.of_change.end());
      row.emplace_back(errors.percent.back());
      table.rows.push_back(std::move(row));
    }
  }
  for (std::size_t i = 0; i < model_count; ++i) {
    const PublishedHealth& theirs = published_of(i, kind);
    if (theirs.size() + 3 != table.columns.size()) break;
    std::vector<Cell> row{"published, first point", model_name(i)};
    row.insert(row.end(), theirs.begin(), theirs.end());
    row.emplace_back(no_number);
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// What each way to constrain is worth.
DataTable ratio_table(const HealthStudy& study) {
  DataTable table{{"point", "model"}, {}};
  for (std::size_t kind = 1; kind < filter_kind_names.size(); ++kind)
    table.columns.push_back(std::string(filter_kind_names[kind]) + " over unconstrained");
  table.columns.emplace_back("published, constrained over unconstrained");
  for (const HealthPoint& point : study.points) {
    for (std::size_t i = 0; i < point.models.size(); ++i) {
      const double plain = errors_of(point.models[i], FilterKind::unconstrained).of_change.back();
      std::vector<Cell> row{point.name, model_name(i)};
      for (std::size_t kind = 1; kind < filter_kind_names.size(); ++kind)
        row.emplace_back(point.models[i].by_kind[kind].of_change.back() / plain);
      const bool known = &point == study.points.data() && i < model_count;
      row.emplace_back(known ? published_models[i].constrained.back() / published_models[i].unconstrained.back()
                             : no_number);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

/// Figures 5.3 (first point) and 5.5 (second): average error by model, with both filters.
void add_models(Section& section, const HealthPoint& point, bool first) {
  const std::string id = first ? "endurthi-4-models" : "endurthi-4-models-second";
  LineChart chart{
      .id = id + "-chart",
      .title = "Error of health by linear model, " + point.name,
      .description =
          "Average error of health with each linear model, by the unconstrained and by the "
          "constrained filter.",
      .x = {"model: 1 is LIN000, 27 is LIN222, 28 the tangent"},
      .y = {"average RMS error of health, % of the true change", false, true},
      .series = {{"ours, unconstrained", {}, {}, 6, Mark::circle}, {"ours, constrained", {}, {}, 1, Mark::circle}}};
  for (std::size_t i = 0; i < point.models.size(); ++i) {
    const double at = static_cast<double>(i + 1);
    chart.series[0].x.push_back(at), chart.series[1].x.push_back(at);
    chart.series[0].y.push_back(errors_of(point.models[i], FilterKind::unconstrained).of_change.back());
    chart.series[1].y.push_back(errors_of(point.models[i], FilterKind::projected).of_change.back());
  }
  if (first) {
    LineSeries plain{"published, unconstrained", {}, {}, 5, Mark::circle},
        constrained{"published, constrained", {}, {}, 2, Mark::circle};
    for (std::size_t i = 0; i < model_count; ++i) {
      plain.x.push_back(static_cast<double>(i + 1)), constrained.x.push_back(static_cast<double>(i + 1));
      plain.y.push_back(published_models[i].unconstrained.back());
      constrained.y.push_back(published_models[i].constrained.back());
    }
    chart.series.push_back(plain), chart.series.push_back(constrained);
  }
  section.add_figure(
      id,
      first ? "The thesis' figures 5.3a and 5.3b: 27 models, " + point.name + "."
            : "The thesis' figures 5.5a and 5.5b: 27 models, " + point.name + ".",
      first ? "On smooth maps all models give one error, so that the points lie on a line; in the thesis they "
              "scatter by a tenth. Its percent are of a change that it does not give."
            : "On smooth maps all models give one error, so that the points lie on a line. The thesis has of "
              "this point a drawing without numbers, whose last nine models rise steeply.",
      responsive(chart), data_of(chart));
}

/// Figures 5.4a and b: one engine's life, both filters in one drawing a parameter.
void add_life(Section& section, const HealthStudy& study, const HealthPoint& point, std::size_t number) {
  const std::string id = "endurthi-4-life-" + std::to_string(number);
  constexpr std::array shown{FilterKind::unconstrained, FilterKind::projected};
  std::vector<LineChart> charts;
  DataTable table{{"health parameter", "flight", "truth [%]", "unconstrained [%]", "constrained [%]"}, {}};
  for (std::size_t i = 0; i < point.health.size(); ++i) {
    LineChart chart{.id = id + "-" + std::to_string(i + 1),
                    .title = point.health[i] + " over 500 flights",
                    .description = "Estimates of " + point.health[i] + " by both filters and its true change.",
                    .x = {"flight"},
                    .y = {"change, % of nominal", false, true},
                    .series = {{"unconstrained", {}, {}, 5, Mark::line, true},
                               {"constrained", {}, {}, 1, Mark::line, true},
                               {"truth", {}, {}, 6, Mark::dashed_line}},
                    .height_px = 190.0,
                    .heading = point.health[i]};
    for (std::size_t flight = 0; flight < point.life.size(); flight += drawn_each) {
      const LifeFlight& now = point.life[flight];
      const double at = static_cast<double>(flight + 1);
      std::vector<Cell> row{point.health[i], at, now.truth[i]};
      for (std::size_t k = 0; k < shown.size(); ++k) {
        chart.series[k].x.push_back(at);
        chart.series[k].y.push_back(now.estimates[as_size(static_cast<int>(shown[k]))][i]);
        row.emplace_back(chart.series[k].y.back());
      }
      chart.series[2].x.push_back(at);
      chart.series[2].y.push_back(now.truth[i]);
      table.rows.push_back(std::move(row));
    }
    charts.push_back(std::move(chart));
  }
  section.add_figure(id,
                     "The thesis' figures 5.4a and 5.4b: a life of " + std::to_string(point.life.size()) +
                         " flights, " + point.name + ".",
                     "One engine on LIN" + model_digits(life_model) + ", made anew at the estimate every " +
                         std::to_string(study.options.relinearised_each) +
                         " flights, where a line may step. Every fourth flight is drawn; scales differ.",
                     panels(charts), std::move(table));
}

std::string set_up(const HealthStudy& study) {
  const HealthStudyOptions& o = study.options;
  return "On " + o.engine->data.name + ": " + counted(o.runs, "run") + " of " + std::to_string(o.flights) +
         " flights of 3 s at 10 Hz, a flight " + fmt::format("{:g}", o.cycles_per_flight) + " cycles of wear; P0 (" +
         fmt::format("{:g}", o.filter.p0_percent) + " %)², Qh " + number(o.filter.qh_percent2) +
         " percent² a sample; linearised with " + fmt::format("{:g}", o.linearised_with_percent) +
         " %. Nine health parameters without LPT flow, which the eleven sensors cannot see. The thesis has MAPSS, a "
         "mixed-flow military engine, without its number 4, and gives neither wear nor P0 nor Q: its numbers are "
         "context, "
         "no target.";
}

}  // namespace

Section health_section(const HealthStudy& study) {
  Section section{"endurthi-4", "Endurthi, tables IV and V: health on 27 linear models"};
  section.add_text(set_up(study));
  for (const HealthPoint& point : study.points) add_models(section, point, &point == study.points.data());
  for (std::size_t i = 0; i < study.points.size(); ++i) add_life(section, study, study.points[i], i + 1);
  section.add_table(
      "endurthi-4-table",
      "Table IV: unconstrained filter, RMS error of health. The published columns are the thesis' numbers "
      "1 to 3 and 5 to 10",
      models_table(study, FilterKind::unconstrained));
  section.add_table("endurthi-5-table", "Table V: constrained filter, RMS error of health",
                    models_table(study, FilterKind::projected));
  section.add_table(
      "endurthi-5-ratios",
      "What the constraint is worth, by three readings of it: average error over that of the unconstrained "
      "filter",
      ratio_table(study));
  return section;
}

}  // namespace ehm::tuner_design::report
