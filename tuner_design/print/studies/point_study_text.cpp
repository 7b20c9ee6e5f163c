// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/point_study_text.h"

#include <fmt/format.h>

#include <cmath>
#include <ostream>

namespace ehm::tuner_design {
namespace {

bool met(const PointError& error) {
  return error.flown <= asked_ssee && std::abs(error.claimed / error.flown - 1.0) <= asked_claim;
}

nlohmann::ordered_json as_json(const PointError& error) {
  return {{"ssee_health", error.flown},
          {"standard_error", error.standard_error},
          {"claimed", error.claimed},
          {"worst_coverage", error.worst_coverage}};
}

}  // namespace

void print_point_study(const PointStudy& study, std::ostream& out) {
  const PointStudyOptions& o = study.options;
  out << fmt::format(
      "Study of single points: engine {}, {} nonlinear engines a point, seed {}; linearised over {} others\n"
      "Squared error of health, percent^2; with Lambda: what the model misses counts in the estimate\n\n",
      o.engine->data.name, o.engines, o.seed, o.fleet);
  out << fmt::format("  {:<16}{:>8}{:>8} |{:>9}{:>7}{:>9}{:>10} |{:>9}{:>9}{:>10}\n", "point", "N1 rpm", "limit",
                     "with", "s.e.", "claimed", "coverage", "without", "claimed", "coverage");
  for (const PointResult& p : study.points)
    out << fmt::format("  {:<16}{:>8.0f}{:>8.2f} |{:>9.2f}{:>7.2f}{:>9.2f}{:>10.3f} |{:>9.2f}{:>9.2f}{:>10.3f}{}\n",
                       p.name, p.n1_rpm, p.limit, p.with.flown, p.with.standard_error, p.with.claimed,
                       p.with.worst_coverage, p.without.flown, p.without.claimed, p.without.worst_coverage,
                       met(p.with) ? "" : "  MISSED");
  out << fmt::format(
      "  asked: with Lambda at most {:g}, claimed within {:g} %; coverage is that of the worst channel\n\n", asked_ssee,
      100.0 * asked_claim);
  out << fmt::format("  {:<24}{:>8}{:>18}{:>8}\n", "one V* for all points", "tuners", "SSEE/limit, mean", "worst");
  for (const SharedTuners& s : study.shared)
    out << fmt::format("  {:<24}{:>8}{:>18.3f}{:>8.3f}\n", s.name, s.tuners, s.mean, s.worst);
}

nlohmann::ordered_json point_study_as_json(const PointStudy& study) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array(), shared = nlohmann::ordered_json::array();
  for (const PointResult& p : study.points)
    points.push_back({{"point", p.name},
                      {"n1_rpm", p.n1_rpm},
                      {"limit", p.limit},
                      {"with_lambda", as_json(p.with)},
                      {"without_lambda", as_json(p.without)},
                      {"met", met(p.with)}});
  for (const SharedTuners& s : study.shared)
    shared.push_back({{"tuners_of", s.name}, {"tuners", s.tuners}, {"mean", s.mean}, {"worst", s.worst}});
  return {{"engines", study.options.engines},
          {"seed", study.options.seed},
          {"points", std::move(points)},
          {"one_for_all", std::move(shared)}};
}

}  // namespace ehm::tuner_design
