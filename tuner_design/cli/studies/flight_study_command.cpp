// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/flight_study_command.h"

#include <cmath>
#include <utility>

#include "deploy/runtime/files/file_error.h"
#include "monitor/design/design_file.h"
#include "monitor/design/make_scheduled.h"
#include "tuner_design/print/studies/flight_study_text.h"
#include "tuner_design/print/studies/margin_study_text.h"
#include "tuner_design/print/studies/point_study_text.h"
#include "tuner_design/print/studies/start_study_text.h"

namespace ehm::tuner_design {
namespace {

/// Of a study whose --fleet is so many engines.
template <class Options>
Options given_to(Options options, const FlightStudyArguments& arguments, const StudyGiven& given) {
  options.engines = arguments.fleet.value_or(options.engines);
  options.engine = given.engine;
  options.seed = given.seed;
  options.threads = given.threads;
  return options;
}

/// For samples of this length, whose noise is as much less as a second brings equal information.
std::shared_ptr<const estimation::Estimator> scheduled_of(const std::string& file, double step_s) {
  if (file.empty()) return nullptr;
  design::Design design = design::read_design(file);
  design.model.sensor_noise_sigma *= std::sqrt(design.model.sample_time_s / step_s);
  design.model.sample_time_s = step_s;
  try {
    return design::make_scheduled_estimator(design, {});
  } catch (const std::invalid_argument& error) {
    throw files::FileError(file + ": " + error.what());
  }
}

}  // namespace

void add_flight_study_options(CLI::App& command, FlightStudyArguments& arguments) {
  command
      .add_option("--fleet", arguments.fleet,
                  "flight: engines of each fleet, default " + std::to_string(arguments.flight.engines) +
                      "; margin: engines, default " + std::to_string(arguments.margin.engines) +
                      "; points: engines at each, default " + std::to_string(arguments.points.engines) +
                      "; family: engines of each case, default 20")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000}));
  command
      .add_option("--step", arguments.flight.step_s,
                  "flight: seconds of a sample; a coarser one than 0.015 has less noise, so that a second brings equal "
                  "information")
      ->check(CLI::Range(0.015, 0.1))
      ->capture_default_str();
  command
      .add_option("--schedule", arguments.schedule,
                  "flight: a design of tuner_design envelope, whose estimator flies too")
      ->check(CLI::ExistingFile)
      ->type_name("D.json");
  command.add_option("--starts", arguments.starts.starts, "starts: missions that are started")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}))
      ->capture_default_str();
}

StudyOutcome whole_flight_study(const FlightStudyArguments& arguments, const StudyGiven& given,
                                const StudyProgress& progress) {
  FlightStudyOptions options = arguments.flight;
  options.engines = arguments.fleet.value_or(options.engines);
  options.engine = given.engine;
  options.draw.seed = given.seed;
  options.threads = given.threads;
  return outcome_of(run_flight_study(options, scheduled_of(arguments.schedule, options.step_s), progress),
                    {print_flight_study, flight_study_as_json});
}

StudyOutcome start_study(const FlightStudyArguments& arguments, const StudyGiven& given,
                         const StudyProgress& progress) {
  StartStudyOptions options = arguments.starts;
  options.engine = given.engine;
  options.seed = given.seed;
  options.threads = given.threads;
  return outcome_of(run_start_study(options, progress), {print_start_study, start_study_as_json});
}

StudyOutcome margin_study(const FlightStudyArguments& arguments, const StudyGiven& given,
                          const StudyProgress& progress) {
  return outcome_of(run_margin_study(given_to(arguments.margin, arguments, given), progress),
                    {print_margin_study, margin_study_as_json});
}

StudyOutcome point_study(const FlightStudyArguments& arguments, const StudyGiven& given,
                         const StudyProgress& progress) {
  return outcome_of(run_point_study(given_to(arguments.points, arguments, given), progress),
                    {print_point_study, point_study_as_json});
}

}  // namespace ehm::tuner_design
