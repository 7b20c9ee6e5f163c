// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/fault_study_command.h"

#include <cmath>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "engine_sim/scenario/mission.h"
#include "monitor/design/design_file.h"
#include "tuner_design/print/studies/false_alarm_text.h"
#include "tuner_design/print/studies/fault_study_text.h"
#include "tuner_design/print/studies/mission_fault_text.h"

namespace ehm::tuner_design {
namespace {

/// `study` of the design, with a progress bar; a design that does not fit is a mistake in its file.
template <class Study>
auto studied(const FaultStudyArguments& arguments, const char* name, const std::string& csv,
             const OutputOptions& output, const Console& console, const Study& study) {
  if (arguments.design.empty()) {
    throw CLI::ValidationError("--design",
                               std::string("is missing; study ") + name + " needs the design that the monitor flies");
  }
  if (!csv.empty()) require_other_file("--csv", csv, {arguments.design});
  const design::Design design = design::read_design(arguments.design);
  long_work::ProgressBar bar = progress_bar(console, output, long_work::ProgressBar::shares);
  try {
    return study(design, [&](double share) { bar.show_share(share); });
  } catch (const std::invalid_argument& error) {
    throw files::FileError(arguments.design + ": " + error.what());
  }
}

void mission_fault_study_of_file(FaultStudyArguments arguments, const std::string& csv, const OutputOptions& output,
                                 const Console& console) {
  MissionFaultOptions& options = arguments.mission;
  options.seed = arguments.options.seed;
  options.threads = arguments.options.threads;
  options.engine = arguments.options.engine;
  options.fault_free =
      static_cast<std::size_t>(std::ceil(3600.0 * arguments.options.hours / engine_sim::mission_seconds));
  const MissionFaultStudy study = studied(arguments, "faults --mission", csv, output, console,
                                          [&](const design::Design& design, const auto& progress) {
                                            return run_mission_fault_study(design, options, progress);
                                          });
  if (!csv.empty()) files::write_file_atomically(csv, mission_fault_study_as_csv(study));
  print_result(
      console, output, [&] { return mission_fault_study_as_json(study); },
      [&](std::ostream& out) { print_mission_fault_study(study, out); });
}

}  // namespace

void add_fault_study_options(CLI::App& command, FaultStudyArguments& arguments) {
  command
      .add_option("--design", arguments.design, "faults, false-alarms, family: design file of the monitor under test")
      ->type_name("D.json");
  CLI::Option* cases =
      command.add_option("--cases", arguments.options.cases, "faults: flights in which something breaks, or nothing")
          ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}))
          ->capture_default_str();
  command.add_option("--hours", arguments.options.hours, "faults, false-alarms: simulated hours with nothing broken")
      ->check(CLI::Range(0.0, 1e5))
      ->capture_default_str();
  CLI::Option* mission =
      command
          .add_option(
              "--mission", arguments.mission.estimator,
              "faults: fly whole two-hour missions with this estimator published, in place of the design's point; "
              "of scheduled the design must have a schedule")
          ->check(CLI::IsMember({"onboard", "scheduled", "tuner"}))
          ->each([&arguments](const std::string&) { arguments.over_missions = true; })
          ->excludes(cases);
  command.add_option("--flights", arguments.mission.flights, "faults --mission: flights in which things break")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000}))
      ->capture_default_str()
      ->needs(mission);
  command.add_flag("!--no-process-noise", arguments.process_noise,
                   "false-alarms: the engine stays in balance; without it, it moves by the model's process noise");
}

void fault_study_of_file(const FaultStudyArguments& arguments, const std::string& csv, const OutputOptions& output,
                         const Console& console) {
  if (arguments.over_missions) {
    return mission_fault_study_of_file(arguments, csv, output, console);
  }
  const FaultStudy study =
      studied(arguments, "faults", csv, output, console, [&](const design::Design& design, const auto& progress) {
        return run_fault_study(design, arguments.options, progress);
      });
  if (!csv.empty()) files::write_file_atomically(csv, fault_study_as_csv(study));
  print_result(
      console, output, [&] { return fault_study_as_json(study); },
      [&](std::ostream& out) { print_fault_study(study, out); });
}

void false_alarm_study_of_file(const FaultStudyArguments& arguments, const std::string& csv,
                               const OutputOptions& output, const Console& console) {
  const FalseAlarmOptions options{arguments.options.hours, arguments.process_noise, arguments.options.seed,
                                  arguments.options.threads};
  const FalseAlarmStudy study =
      studied(arguments, "false-alarms", csv, output, console, [&](const design::Design& design, const auto& progress) {
        return run_false_alarm_study(design, options, progress);
      });
  if (!csv.empty()) files::write_file_atomically(csv, false_alarms_as_csv(study));
  print_result(
      console, output, [&] { return false_alarms_as_json(study); },
      [&](std::ostream& out) { print_false_alarms(study, out); });
}

}  // namespace ehm::tuner_design
