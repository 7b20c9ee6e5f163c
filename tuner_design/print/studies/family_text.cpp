// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/family_text.h"

#include <fmt/format.h>

#include <ostream>

namespace ehm::tuner_design {
namespace {

const char* name_of(FamilyCase what) {
  return family_case_names[static_cast<std::size_t>(what)];
}

}  // namespace

void print_family_study(const FamilyStudy& s, std::ostream& out) {
  out << fmt::format(
      "Every estimator on the same samples: design '{}', {} engines a case, seed {}\n"
      "Limit of constant health after 40 s: SSEE {:.2f} percent^2 (time-varying Kalman filter on its own model)\n",
      s.design_name, s.options.engines, s.options.seed, s.limit);
  for (const FamilyCaseResult& c : s.cases) {
    out << fmt::format("\n{}: {} engines{}\n", name_of(c.what), c.flown,
                       c.failed ? fmt::format(", {} did not fly to the end and are in no figure", c.failed) : "");
    out << fmt::format("  {:<14}{:>8}{:>12}{:>12}{:>10}{:>8}{:>9}{:>10}\n", "estimator", "held %", "SSEE", "claims",
                       "coverage", "least", "bias %", c.what == FamilyCase::rapid ? "answer s" : "");
    for (std::size_t e = 0; e < s.estimators.size(); ++e) {
      const auto& score = c.scores[e];
      if (!score) {
        out << fmt::format("  {:<14}{:>8}\n", s.estimators[e], "-");
        continue;
      }
      out << fmt::format(
          "  {:<14}{:>8.1f}{:>12.2f}{:>12.2f}{:>10.3f}{:>8.3f}{:>9.3f}{:>10}\n", s.estimators[e], 100.0 * score->held,
          score->ssee, score->claims, score->coverage, score->least_coverage, score->bias,
          score->answer_s ? fmt::format("{:.2f}", *score->answer_s) : (c.what == FamilyCase::rapid ? "never" : ""));
    }
  }
  for (const std::string& name : s.left_out) out << fmt::format("\n{}: the design has not what it needs\n", name);
}

nlohmann::ordered_json family_study_as_json(const FamilyStudy& s) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const FamilyCaseResult& c : s.cases) {
    nlohmann::ordered_json scores;
    for (std::size_t e = 0; e < s.estimators.size(); ++e) {
      const auto& score = c.scores[e];
      if (!score) continue;
      nlohmann::ordered_json json{{"held", score->held},
                                  {"ssee_percent2", score->ssee},
                                  {"claims_percent2", score->claims},
                                  {"coverage", score->coverage},
                                  {"least_coverage", score->least_coverage},
                                  {"bias_percent", score->bias}};
      if (score->answer_s) json["answer_s"] = *score->answer_s;
      scores[s.estimators[e]] = std::move(json);
    }
    cases.push_back({{"case", name_of(c.what)}, {"flown", c.flown}, {"failed", c.failed}, {"estimators", scores}});
  }
  return {{"design", s.design_name},   {"engines", s.options.engines}, {"seed", s.options.seed},
          {"limit_percent2", s.limit}, {"left_out", s.left_out},       {"cases", cases}};
}

std::string family_study_as_csv(const FamilyStudy& s) {
  std::string csv = "case,estimator,held,ssee_percent2,claims_percent2,coverage,least_coverage,bias_percent,answer_s\n";
  for (const FamilyCaseResult& c : s.cases)
    for (std::size_t e = 0; e < s.estimators.size(); ++e)
      if (const auto& score = c.scores[e])
        csv += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", name_of(c.what), s.estimators[e],
                           score->held, score->ssee, score->claims, score->coverage, score->least_coverage, score->bias,
                           score->answer_s ? fmt::format("{:.3f}", *score->answer_s) : "");
  return csv;
}

}  // namespace ehm::tuner_design
