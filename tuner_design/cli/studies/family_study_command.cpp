// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/family_study_command.h"

#include <vector>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "monitor/design/design_file.h"
#include "tuner_design/print/studies/family_text.h"

namespace ehm::tuner_design {

void add_family_study_options(CLI::App& command, FamilyOptions& options) {
  command.add_flag_callback(
      "--no-whole-flight", [&options] { std::erase(options.cases, FamilyCase::flight); },
      "family: without the two-hour flights");
}

void family_study(const std::string& design_file, const FamilyOptions& options, const std::string& csv,
                  const OutputOptions& output, const Console& console) {
  if (design_file.empty())
    throw CLI::ValidationError("--design", "is missing; study family needs the design that the estimators are made of");
  if (!csv.empty()) require_other_file("--csv", csv, {design_file});
  const design::Design design = design::read_design(design_file);
  FamilyStudy study;
  try {
    long_work::ProgressBar bar = progress_bar(console, output, long_work::ProgressBar::shares);
    study = run_family_study(design, options, [&](double share) { bar.show_share(share); });
  } catch (const std::invalid_argument& error) {
    throw files::FileError(design_file + ": " + error.what());
  }
  if (!csv.empty()) files::write_file_atomically(csv, family_study_as_csv(study));
  print_result(
      console, output, [&] { return family_study_as_json(study); },
      [&](std::ostream& out) { print_family_study(study, out); });
}

}  // namespace ehm::tuner_design
