// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/endurthi_linear_text.h"

#include <fmt/format.h>

#include <ostream>

#include "tuner_design/endurthi/best_models.h"
#include "tuner_design/endurthi/published.h"

namespace ehm::tuner_design {
namespace {

using namespace endurthi;

ErrorPart part(int table) {
  return table == 1 ? &ModelError::average : &ModelError::final;
}

void print_head(const LinearisationStudy& study, int table, std::ostream& out) {
  constexpr const char* titles[] = {"Table I: the best of 27 linear models, RMS error averaged over 6 s",
                                    "Table II: the best of 27 linear models, RMS error after 6 s",
                                    "Table III: the 27 linear models, linearised and tested with 0.01 %"};
  out << titles[table - 1]
      << fmt::format(
             "\nOurs: {}, separate flows, smooth maps, balances closed to 1e-10; 3 states (N1, N2, metal of the LPT), "
             "3 "
             "controls\n(fuel, stator vanes, core nozzle), 9 health parameters, 11 sensors. Published (Endurthi): "
             "MAPSS, "
             "a mixed-flow\nmilitary engine, tables with corners. LINxyz: states x, controls y, health z; 0 "
             "perturbation, "
             "1 linmod, 2 steady state\nErrors: percent of trim per percent of perturbation, RMS over the sensors\n",
             study.options.engine->data.name);
}

/// One line of a table of cells: a name, and an entry for each perturbation under test.
template <class Entry>
void print_line(const std::string& first, const std::string& second, const Entry& entry, std::ostream& out) {
  out << fmt::format("  {:<10}{:<12}", first, second);
  for (std::size_t test = 0; test < studied_percents.size(); ++test) out << fmt::format("{:>22}", entry(test));
  out << '\n';
}

void print_best(const LinearisationPoint& point, int table, bool published, std::ostream& out) {
  const auto wanted = part(table);
  const std::size_t theirs = table == 1 ? published_average_model : published_final_model;
  out << fmt::format("\n{}, N1 {:.0f} rpm\n", point.name, point.n1_rpm);
  print_line(
      "linearised", "", [](std::size_t test) { return fmt::format("tested with {:g} %", studied_percents[test]); },
      out);
  for (std::size_t linearised = 0; linearised < studied_percents.size(); ++linearised) {
    const auto& row = point.errors[linearised];
    const auto value = [&](std::size_t model) {
      return [&, model](std::size_t test) { return fmt::format("{:.3g}", row[test][model].*wanted); };
    };
    const auto best = [&](std::size_t test) {
      const std::size_t model = best_of(row[test], wanted);
      return fmt::format("{} {:.3g}", model_name(model), row[test][model].*wanted);
    };
    print_line(fmt::format("{:g} %", studied_percents[linearised]), "best", best, out);
    print_line("", model_name(theirs), value(theirs), out);
    print_line("", "tangent", value(tangent_model), out);
    if (published)
      print_line(
          "", "published", [&](std::size_t test) { return published_best(table, linearised, test); }, out);
  }
  const std::size_t safest = safest_of(point, wanted);
  out << fmt::format("  worst cell, times the best there: {} {:.2f} (least of all), tangent {:.2f}, {} {:.1f}\n",
                     model_name(safest), worst_ratio(point, safest, wanted), worst_ratio(point, tangent_model, wanted),
                     model_name(theirs), worst_ratio(point, theirs, wanted));
}

void print_groups(const LinearisationPoint& point, std::ostream& out) {
  for (std::size_t k = 0; k < studied_percents.size(); ++k) {
    out << fmt::format("  {}, linearised with {:g} %: {} of 27 differ by more than {:g} of a column", point.name,
                       studied_percents[k], point.groups[k].size(), closeness);
    if (point.groups[k].size() > 9) {
      out << '\n';
      continue;
    }
    out << ':';
    for (const auto& group : point.groups[k])
      out << fmt::format(" LIN{}{}", model_digits(group.front()),
                         group.size() > 1 ? fmt::format(" (and {})", group.size() - 1) : "");
    out << '\n';
  }
}

void print_all(const LinearisationStudy& study, std::ostream& out) {
  out << "With a corner: health beyond "
      << fmt::format("{:g} % of wear acts {:g} % more", -100.0 * corner_health, 100.0 * corner_steeper)
      << ", open loop: linmod's step does not reach the corner, the others do\n\n";
  out << fmt::format("  {:<10}{:^20}", "x 1e-4", "published");
  for (const LinearisationPoint& point : study.points) out << fmt::format(" |{:^40}", point.name);
  out << fmt::format("\n  {:<10}{:>10}{:>10}", "", "average", "final");
  for (std::size_t i = 0; i < study.points.size(); ++i)
    out << fmt::format(" |{:>10}{:>10}{:>10}{:>10}", "average", "final", "corner", "final");
  out << '\n';
  for (std::size_t model = 0; model <= model_count; ++model) {
    out << fmt::format("  {:<10}", model_name(model));
    if (model < model_count)
      out << fmt::format("{:>10.2f}{:>10.2f}", published_models[model].average_1e4, published_models[model].final_1e4);
    else
      out << fmt::format("{:>20}", "");
    for (const LinearisationPoint& point : study.points) {
      const ModelError &plain = point.errors[0][0][model], &corner = point.with_corner[model];
      out << fmt::format(" |{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}", 1e4 * plain.average, 1e4 * plain.final,
                         1e4 * corner.average, 1e4 * corner.final);
    }
    out << '\n';
  }
}

/// Every error: `row` is called with point, percents, whether with a corner, model and error.
template <class Row>
void for_each_error(const LinearisationStudy& study, const Row& row) {
  for (const LinearisationPoint& point : study.points) {
    for (std::size_t k = 0; k < studied_percents.size(); ++k)
      for (std::size_t test = 0; test < studied_percents.size(); ++test)
        for (std::size_t model = 0; model <= model_count; ++model)
          row(point, studied_percents[k], studied_percents[test], false, model, point.errors[k][test][model]);
    for (std::size_t model = 0; model <= model_count; ++model)
      row(point, studied_percents[0], studied_percents[0], true, model, point.with_corner[model]);
  }
}

}  // namespace

void print_linearisation_study(const LinearisationStudy& study, int table, std::ostream& out) {
  print_head(study, table, out);
  if (table == 3)
    print_all(study, out);
  else
    for (const LinearisationPoint& point : study.points) print_best(point, table, &point == study.points.data(), out);
  out << "\nOn smooth maps models coincide, and which is best is decided by the steps alone:\n";
  for (const LinearisationPoint& point : study.points) print_groups(point, out);
}

nlohmann::ordered_json linearisation_study_as_json(const LinearisationStudy& study) {
  nlohmann::ordered_json errors = nlohmann::ordered_json::array(), groups = nlohmann::ordered_json::array();
  for_each_error(study, [&](const LinearisationPoint& point, double linearised, double test, bool corner,
                            std::size_t model, const ModelError& error) {
    errors.push_back({{"point", point.name},
                      {"linearised_with_percent", linearised},
                      {"tested_with_percent", test},
                      {"corner", corner},
                      {"model", model_name(model)},
                      {"average", error.average},
                      {"final", error.final}});
  });
  for (const LinearisationPoint& point : study.points)
    for (std::size_t k = 0; k < studied_percents.size(); ++k)
      groups.push_back({{"point", point.name},
                        {"linearised_with_percent", studied_percents[k]},
                        {"distinct", point.groups[k].size()}});
  return {{"engine", study.options.engine->data.name}, {"errors", std::move(errors)}, {"groups", std::move(groups)}};
}

std::string linearisation_study_csv(const LinearisationStudy& study) {
  std::string text = "point,linearised_with_percent,tested_with_percent,corner,model,average,final\n";
  for_each_error(study, [&](const LinearisationPoint& point, double linearised, double test, bool corner,
                            std::size_t model, const ModelError& error) {
    text += fmt::format("\"{}\",{},{},{},{},{},{}\n", point.name, linearised, test, corner ? 1 : 0, model_name(model),
                        error.average, error.final);
  });
  for (std::size_t model = 0; model < model_count; ++model)
    text += fmt::format("published,{0},{0},0,{1},{2},{3}\n", studied_percents[0], model_name(model),
                        1e-4 * published_models[model].average_1e4, 1e-4 * published_models[model].final_1e4);
  return text;
}

}  // namespace ehm::tuner_design
