// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/family_study_command.h"

#include <algorithm>
#include <string>
#include <vector>

#include "deploy/runtime/files/file_error.h"
#include "monitor/design/design_file.h"
#include "monitor/design/make_estimator.h"
#include "tuner_design/print/studies/family_text.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design {

void add_family_study_options(CLI::App& command, FamilyOptions& options) {
  command.add_flag_callback(
      "--no-whole-flight", [&options] { std::erase(options.cases, FamilyCase::flight); },
      "family: without the two-hour flights");
  std::vector<std::string> known;
  for (const design::EstimatorKind& kind : design::estimator_kinds()) known.emplace_back(kind.name);
  command.add_option("--estimators", options.estimators, "family: these alone, with commas between")
      ->delimiter(',')
      ->check(CLI::IsMember(known));
  const std::vector<std::string> cases(family_case_names.begin(), family_case_names.end());
  command
      .add_option_function<std::vector<std::string>>(
          "--family-cases",
          [&options](const std::vector<std::string>& wanted) {
            options.cases.clear();
            for (std::size_t c = 0; c < family_case_names.size(); ++c)
              if (std::ranges::count(wanted, family_case_names[c]) > 0)
                options.cases.push_back(static_cast<FamilyCase>(c));
          },
          "family: these alone, with commas between")
      ->delimiter(',')
      ->check(CLI::IsMember(cases));
}

StudyOutcome family_study(const std::string& design_file, FamilyOptions options, const StudyGiven& given,
                          const StudyProgress& progress) {
  if (design_file.empty())
    throw CLI::ValidationError("--design", "is missing; study family needs the design that the estimators are made of");
  const design::Design design = design::read_design(design_file);
  options.engine = given.engine;
  options.seed = given.seed;
  options.threads = given.threads;
  try {
    return outcome_of(run_family_study(design, options, progress),
                      {print_family_study, family_study_as_json, family_study_as_csv, report::family_section});
  } catch (const std::invalid_argument& error) {
    throw files::FileError(design_file + ": " + error.what());
  }
}

}  // namespace ehm::tuner_design
