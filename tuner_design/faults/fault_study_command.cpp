#include "tuner_design/faults/fault_study_command.h"

#include "deploy/files/atomic_file.h"
#include "monitor/design/design_file.h"
#include "monitor/design/file_error.h"
#include "tuner_design/faults/fault_study_report.h"

namespace ehm::bench {

void add_fault_study_options(CLI::App& command, FaultStudyArguments& arguments) {
  command.add_option("--design", arguments.design, "faults: design file of the monitor under test")
      ->type_name("D.json");
  command.add_option("--cases", arguments.options.cases, "faults: flights in which something breaks, or nothing")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}))
      ->capture_default_str();
  command.add_option("--hours", arguments.options.hours, "faults: simulated hours with nothing broken")
      ->check(CLI::Range(0.0, 1e5))
      ->capture_default_str();
}

void fault_study_of_file(const FaultStudyArguments& arguments, const std::string& csv, const OutputOptions& output,
                         const Console& console) {
  constexpr std::size_t progress_steps = 1000;
  if (arguments.design.empty())
    throw CLI::ValidationError("--design", "is missing; study faults needs the design that the monitor flies");
  if (!csv.empty()) require_other_file("--csv", csv, {arguments.design});
  const design::Design design = design::read_design(arguments.design);
  FaultStudy study;
  try {
    work::ProgressBar bar = progress_bar(console, output, progress_steps);
    study = run_fault_study(design, arguments.options, [&](double share) {
      bar.show(static_cast<std::size_t>(share * static_cast<double>(progress_steps)));
    });
  } catch (const std::invalid_argument& error) {
    throw design::FileError(arguments.design + ": " + error.what());
  }
  if (!csv.empty()) files::write_file_atomically(csv, fault_study_as_csv(study));
  print_result(
      console, output, [&] { return fault_study_as_json(study); },
      [&](std::ostream& out) { print_fault_study(study, out); });
}

}  // namespace ehm::bench
