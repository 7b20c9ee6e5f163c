// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/endurthi_health_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <span>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/endurthi/published.h"

namespace ehm::tuner_design {
namespace {

using namespace endurthi;

FilterKind kind_of(int table) {
  return table == 4 ? FilterKind::unconstrained : FilterKind::projected;
}

const HealthErrors& errors_of(const ModelHealth& model, FilterKind kind) {
  return model.by_kind[as_size(kind)];
}

double mean_of(const ModelHealth& model, FilterKind kind) {
  return errors_of(model, kind).of_change.back();
}

std::string name_of(const ModelHealth& model) {
  return model.model == "tangent" ? model.model : "LIN" + model.model;
}

std::string values(std::span<const double> numbers, int width, int digits) {
  std::string text;
  for (const double number : numbers) text += fmt::format("{:>{}.{}f}", number, width, digits);
  return text;
}

/// "fan_efficiency" as "fan_eff".
std::string short_name(const std::string& name) {
  return name.substr(0, name.find("iciency"));
}

void print_head(const HealthStudy& study, int table, std::ostream& out) {
  const HealthStudyOptions& o = study.options;
  out << (table == 4 ? "Table IV: unconstrained" : "Table V: constrained")
      << fmt::format(
             " time-varying Kalman filter on 27 linear models, RMS error of health\n{} runs of {} flights of 3 s at 10 "
             "Hz, a flight {:g} cycles of wear; P0 ({:g} %)^2, Qh {:g} percent^2 a sample; linearised with {:g} %, "
             "seed "
             "{}\nOurs: {}, nine health parameters without LPT flow, which its 11 sensors cannot see; P13 and P21 are "
             "one quantity.\nPublished (Endurthi): MAPSS, a mixed-flow military engine, without its number 4; wear, P0 "
             "and Q are not given there\n",
             o.runs, o.flights, o.cycles_per_flight, o.filter.p0_percent, o.filter.qh_percent2,
             o.linearised_with_percent, o.seed, o.engine->data.name);
}

/// Best of the 27 and the spread of all, in one line.
void print_range(const HealthPoint& point, FilterKind kind, std::ostream& out) {
  const auto [best, worst] =
      std::minmax_element(point.models.begin(), point.models.begin() + model_count,
                          [&](const auto& a, const auto& b) { return mean_of(a, kind) < mean_of(b, kind); });
  out << fmt::format("  best {} {:.2f}, worst {} {:.2f}, tangent {:.2f} percent of the change\n", name_of(*best),
                     mean_of(*best, kind), name_of(*worst), mean_of(*worst, kind), mean_of(point.models.back(), kind));
}

void print_models(const HealthPoint& point, FilterKind kind, std::ostream& out) {
  out << fmt::format("\n{}, N1 {:.0f} rpm, percent of the true change\n  {:<10}", point.name, point.n1_rpm, "");
  for (const std::string& name : point.health) out << fmt::format("{:>9}", short_name(name));
  out << fmt::format("{:>9}{:>12}\n  {:<10}", "average", "absolute %", "true %");
  for (Eigen::Index i = 0; i < point.change.size(); ++i) out << fmt::format("{:>9.2f}", point.change(i));
  out << '\n';
  for (const ModelHealth& model : point.models) {
    const HealthErrors& errors = errors_of(model, kind);
    out << fmt::format("  {:<10}{}{:>12.3f}\n", name_of(model), values(errors.of_change, 9, 2), errors.percent.back());
  }
  print_range(point, kind, out);
}

void print_published(int table, std::ostream& out) {
  out << fmt::format("\nPublished, first point\n  {:<10}", "");
  for (const int number : {1, 2, 3, 5, 6, 7, 8, 9, 10}) out << fmt::format("{:>9}", number);
  out << fmt::format("{:>9}\n", "average");
  for (std::size_t model = 0; model < model_count; ++model) {
    const PublishedModel& m = published_models[model];
    out << fmt::format("  LIN{:<7}{}\n", model_digits(model),
                       values(table == 4 ? m.unconstrained : m.constrained, 9, 2));
  }
  out << (table == 4 ? "  best LIN120 7.04; second point LIN200 (figure 5.5)\n"
                     : "  best LIN120 6.29; second point LIN200 (figure 5.5)\n");
}

void print_constraint(const HealthPoint& point, bool published, std::ostream& out) {
  out << fmt::format("\n{}: average error over that of the unconstrained filter\n  {:<10}", point.name, "");
  for (std::size_t kind = 1; kind < filter_kind_names.size(); ++kind)
    out << fmt::format("{:>14}", filter_kind_names[kind]);
  out << fmt::format("{}\n", published ? "     published" : "");
  for (std::size_t i = 0; i < point.models.size(); ++i) {
    const ModelHealth& model = point.models[i];
    out << fmt::format("  {:<10}", name_of(model));
    for (std::size_t kind = 1; kind < filter_kind_names.size(); ++kind)
      out << fmt::format("{:>14.3f}",
                         mean_of(model, static_cast<FilterKind>(kind)) / mean_of(model, FilterKind::unconstrained));
    if (published && i < model_count)
      out << fmt::format("{:>14.3f}",
                         published_models[i].constrained.back() / published_models[i].unconstrained.back());
    out << '\n';
  }
}

void print_life(const HealthStudy& study, const HealthPoint& point, FilterKind kind, std::ostream& out) {
  const std::size_t each = study.options.relinearised_each;
  out << fmt::format(
      "\n{}, one run of {} flights, LIN{} made anew at the estimate every {} (figure 5.4), percent\n  {:<10}",
      point.name, study.options.life_flights, model_digits(life_model), each, "flight");
  for (const std::string& name : point.health) out << fmt::format("{:>9}", short_name(name));
  out << '\n';
  for (std::size_t flight = each; flight <= point.life.size(); flight += each) {
    const LifeFlight& now = point.life[flight - 1];
    out << fmt::format("  {:<10}{}  true\n  {:<10}{}  estimated\n", flight, values(now.truth, 9, 2), "",
                       values(now.estimates[as_size(kind)], 9, 2));
  }
}

}  // namespace

void print_health_study(const HealthStudy& study, int table, std::ostream& out) {
  const FilterKind kind = kind_of(table);
  print_head(study, table, out);
  for (const HealthPoint& point : study.points) {
    const bool first = &point == study.points.data();
    print_models(point, kind, out);
    if (first) print_published(table, out);
    if (table == 5) print_constraint(point, first, out);
    print_life(study, point, kind, out);
  }
}

nlohmann::ordered_json health_study_as_json(const HealthStudy& study) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const HealthPoint& point : study.points) {
    nlohmann::ordered_json models = nlohmann::ordered_json::array();
    for (const ModelHealth& model : point.models)
      for (std::size_t kind = 0; kind < filter_kind_names.size(); ++kind)
        models.push_back({{"model", name_of(model)},
                          {"filter", filter_kind_names[kind]},
                          {"percent_of_change", model.by_kind[kind].of_change},
                          {"percent", model.by_kind[kind].percent}});
    points.push_back({{"point", point.name}, {"health", point.health}, {"models", std::move(models)}});
  }
  return {{"engine", study.options.engine->data.name}, {"seed", study.options.seed}, {"points", std::move(points)}};
}

std::string health_study_csv(const HealthStudy& study) {
  std::string text = "point,kind,row,filter,unit";
  for (const std::string& name : study.points.front().health) text += "," + name;
  text += ",average\n";
  const auto line = [&](const std::string& point, const char* kind, const std::string& row, std::string_view filter,
                        const char* unit, std::span<const double> numbers) {
    text += fmt::format("\"{}\",{},{},{},{}", point, kind, row, filter, unit);
    for (const double number : numbers) text += fmt::format(",{}", number);
    text += '\n';
  };
  for (const HealthPoint& point : study.points) {
    for (const ModelHealth& model : point.models)
      for (std::size_t kind = 0; kind < filter_kind_names.size(); ++kind) {
        line(point.name, "rms", name_of(model), filter_kind_names[kind], "percent of change",
             model.by_kind[kind].of_change);
        line(point.name, "rms", name_of(model), filter_kind_names[kind], "percent", model.by_kind[kind].percent);
      }
    for (std::size_t flight = 0; flight < point.life.size(); ++flight) {
      const LifeFlight& now = point.life[flight];
      line(point.name, "flight", std::to_string(flight + 1), "truth", "percent", now.truth);
      for (std::size_t kind = 0; kind < filter_kind_names.size(); ++kind)
        line(point.name, "flight", std::to_string(flight + 1), filter_kind_names[kind], "percent", now.estimates[kind]);
    }
  }
  for (std::size_t model = 0; model < model_count; ++model) {
    const PublishedModel& m = published_models[model];
    line("published", "rms", "LIN" + model_digits(model), "unconstrained", "percent of change", m.unconstrained);
    line("published", "rms", "LIN" + model_digits(model), "constrained", "percent of change", m.constrained);
  }
  return text;
}

}  // namespace ehm::tuner_design
