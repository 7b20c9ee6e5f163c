// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/margin_study_text.h"

#include <fmt/format.h>

#include <ostream>

namespace ehm::tuner_design {

void print_margin_study(const MarginStudy& study, std::ostream& out) {
  const MarginStudyOptions& o = study.options;
  out << fmt::format(
      "Margin study: {} engines {} over {} cycles, a mission of half an hour every {}, each from what the last has "
      "taught; seed {}\n\n",
      o.engines, o.engine->data.name, life_cycles, cycles_between, o.seed);
  out << fmt::format("  {:>6}{:>14}{:>14}{:>12}{:>11}\n", "cycles", "EGT margin K", "error rms K", "sigma K",
                     "coverage");
  for (const MarginAtCycles& at : study.by_cycles)
    out << fmt::format("  {:>6}{:>14.1f}{:>14.2f}{:>12.2f}{:>11.2f}\n", at.cycles, at.truth_k, at.error_rms_k,
                       at.sigma_k, at.coverage);
  out << fmt::format("\n  {:<34}{:>10}   {}\n", "figure", "measured", "asked");
  out << fmt::format("  {:<34}{:>10.2f}   at most 2{}\n", "error, K rms, of all flights", study.error_rms_k,
                     study.error_rms_k <= 2.0 ? "" : "  MISSED");
  out << fmt::format("  {:<34}{:>10.3f}   0.9 to 0.98{}\n", "coverage", study.coverage,
                     study.coverage >= 0.9 && study.coverage <= 0.98 ? "" : "  MISSED");
  for (const FailedEngine& e : study.failed) out << fmt::format("  engine {} is in no figure: {}\n", e.index, e.why);
}

nlohmann::ordered_json margin_study_as_json(const MarginStudy& study) {
  nlohmann::ordered_json failed = nlohmann::ordered_json::array(), by_cycles = nlohmann::ordered_json::array();
  for (const FailedEngine& e : study.failed) failed.push_back({{"engine", e.index}, {"why", e.why}});
  for (const MarginAtCycles& at : study.by_cycles)
    by_cycles.push_back({{"cycles", at.cycles},
                         {"margin_k", at.truth_k},
                         {"error_rms_k", at.error_rms_k},
                         {"sigma_k", at.sigma_k},
                         {"coverage", at.coverage}});
  return {{"engines", study.options.engines}, {"seed", study.options.seed},       {"failed", failed},
          {"by_cycles", by_cycles},           {"error_rms_k", study.error_rms_k}, {"coverage", study.coverage}};
}

}  // namespace ehm::tuner_design
