// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/fault_study_command.h"

#include <cmath>

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/scenario/mission.h"
#include "monitor/design/design_file.h"
#include "tuner_design/print/studies/false_alarm_text.h"
#include "tuner_design/print/studies/fault_study_text.h"
#include "tuner_design/print/studies/mission_fault_text.h"

namespace ehm::tuner_design {
namespace {

/// `run` of the design; one that does not fit is a mistake in its file.
template <class Run>
StudyOutcome of_design(const std::string& file, const char* name, const Run& run) {
  if (file.empty())
    throw CLI::ValidationError("--design",
                               std::string("is missing; study ") + name + " needs the design that the monitor flies");
  const design::Design design = design::read_design(file);
  try {
    return run(design);
  } catch (const std::invalid_argument& error) {
    throw files::FileError(file + ": " + error.what());
  }
}

StudyOutcome mission_study(const FaultStudyArguments& arguments, const StudyGiven& given,
                           const StudyProgress& progress) {
  MissionFaultOptions options = arguments.mission;
  options.seed = given.seed;
  options.threads = given.threads;
  options.engine = given.engine;
  options.fault_free =
      static_cast<std::size_t>(std::ceil(3600.0 * arguments.options.hours / engine_sim::mission_seconds));
  return of_design(arguments.design, "faults --mission", [&](const design::Design& design) {
    return outcome_of(run_mission_fault_study(design, options, progress),
                      {print_mission_fault_study, mission_fault_study_as_json, mission_fault_study_as_csv});
  });
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

StudyOutcome fault_study(const FaultStudyArguments& arguments, const StudyGiven& given, const StudyProgress& progress) {
  if (arguments.over_missions) return mission_study(arguments, given, progress);
  FaultStudyOptions options = arguments.options;
  options.seed = given.seed;
  options.threads = given.threads;
  options.engine = given.engine;
  return of_design(arguments.design, "faults", [&](const design::Design& design) {
    return outcome_of(run_fault_study(design, options, progress),
                      {print_fault_study, fault_study_as_json, fault_study_as_csv});
  });
}

StudyOutcome false_alarm_study(const FaultStudyArguments& arguments, const StudyGiven& given,
                               const StudyProgress& progress) {
  const FalseAlarmOptions options{arguments.options.hours, arguments.process_noise, given.seed, given.threads};
  return of_design(arguments.design, "false-alarms", [&](const design::Design& design) {
    return outcome_of(run_false_alarm_study(design, options, progress),
                      {print_false_alarms, false_alarms_as_json, false_alarms_as_csv});
  });
}

}  // namespace ehm::tuner_design
