// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/lu_study_command.h"

#include "tuner_design/print/studies/lu_text.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design {

void add_lu_study_options(CLI::App& command, LuOptions& options) {
  command.add_option("--repeats", options.runs, "lu-4 to lu-9: runs of each case, where the paper has one")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10'000}))
      ->capture_default_str();
  command.add_option("--particles", options.particles, "lu-4 to lu-8: particles of PF, EKPF and cEKPF")
      ->check(CLI::Range(2, 10'000))
      ->capture_default_str();
}

StudyOutcome lu_study(const std::string& name, LuOptions options, const StudyGiven& given,
                      const StudyProgress& progress) {
  options.table = name.back() - '0';
  options.engine = given.engine;
  options.seed = given.seed;
  options.threads = given.threads;
  return outcome_of(run_lu_study(options, progress),
                    {print_lu_study, lu_study_as_json, lu_study_as_csv, report::lu_section});
}

}  // namespace ehm::tuner_design
