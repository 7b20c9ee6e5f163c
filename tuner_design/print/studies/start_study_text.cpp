// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/start_study_text.h"

#include <fmt/format.h>

#include <ostream>

namespace ehm::tuner_design {

void print_start_study(const StartStudy& study, std::ostream& out) {
  const StartStudyOptions& o = study.options;
  out << fmt::format(
      "Start study: {} missions of engines {}, everything perturbed, seed {}; each trimmed at taxi and flown {:g} "
      "s\n\n",
      o.starts, o.engine->data.name, o.seed, start_seconds);
  out << fmt::format("  failed {} (asked 0){}\n", study.failed.size(), study.failed.empty() ? "" : "  MISSED");
  out << "  least stall margins, percent:";
  for (std::size_t k = 0; k < stall_margins.size(); ++k)
    out << fmt::format(" {} {:.2f}", stall_margins[k], study.least_margin_percent[k]);
  out << '\n';
  for (const FailedEngine& e : study.failed) out << fmt::format("  engine {}: {}\n", e.index, e.why);
}

nlohmann::ordered_json start_study_as_json(const StartStudy& study) {
  nlohmann::ordered_json failed = nlohmann::ordered_json::array(), margins;
  for (const FailedEngine& e : study.failed) failed.push_back({{"engine", e.index}, {"why", e.why}});
  for (std::size_t k = 0; k < stall_margins.size(); ++k)
    margins[std::string(stall_margins[k])] = study.least_margin_percent[k];
  return {{"starts", study.options.starts},
          {"seed", study.options.seed},
          {"failed", failed},
          {"least_stall_margin_percent", margins}};
}

}  // namespace ehm::tuner_design
