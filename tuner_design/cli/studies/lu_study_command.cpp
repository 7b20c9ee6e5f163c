// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/lu_study_command.h"

#include "deploy/runtime/files/atomic_file.h"
#include "tuner_design/print/studies/lu_text.h"

namespace ehm::tuner_design {

void add_lu_study_options(CLI::App& command, LuOptions& options) {
  command.add_option("--repeats", options.runs, "lu-4 to lu-9: runs of each case, where the paper has one")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10'000}))
      ->capture_default_str();
  command.add_option("--particles", options.particles, "lu-4 to lu-8: particles of PF, EKPF and cEKPF")
      ->check(CLI::Range(2, 10'000))
      ->capture_default_str();
}

void lu_study(const std::string& name, LuOptions options, const std::string& csv, const OutputOptions& output,
              const Console& console) {
  options.table = name.back() - '0';
  long_work::ProgressBar bar = progress_bar(console, output, long_work::ProgressBar::shares);
  const LuStudy study = run_lu_study(options, [&](double share) { bar.show_share(share); });
  if (!csv.empty()) files::write_file_atomically(csv, lu_study_as_csv(study));
  print_result(
      console, output, [&] { return lu_study_as_json(study); }, [&](std::ostream& out) { print_lu_study(study, out); });
}

}  // namespace ehm::tuner_design
