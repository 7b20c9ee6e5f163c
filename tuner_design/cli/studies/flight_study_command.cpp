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

/// Runs a study beside a progress bar, and prints it in one of its two forms.
template <class Run, class Print, class AsJson>
void show(const OutputOptions& output, const Console& console, const Run& run, const Print& print,
          const AsJson& as_json) {
  long_work::ProgressBar bar = progress_bar(console, output, long_work::ProgressBar::shares);
  const auto study = run([&](double share) { bar.show_share(share); });
  print_result(
      console, output, [&] { return as_json(study); }, [&](std::ostream& out) { print(study, out); });
}

template <class Options>
Options given_to(Options options, const StudyGiven& given) {
  options.engine = given.engine;
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

bool is_flight_study(const std::string& study) {
  return study == "flight" || study == "starts" || study == "margin" || study == "points";
}

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

void flight_study(const std::string& study, const FlightStudyArguments& arguments, const StudyGiven& given,
                  const OutputOptions& output, const Console& console) {
  if (study == "starts") {
    StartStudyOptions options = given_to(arguments.starts, given);
    options.seed = given.seed;
    return show(
        output, console, [&](const auto& progress) { return run_start_study(options, progress); }, print_start_study,
        start_study_as_json);
  }
  const auto show_of_engines = [&](auto options, const auto& run, const auto& print, const auto& as_json) {
    options = given_to(std::move(options), given);
    options.seed = given.seed;
    options.engines = arguments.fleet.value_or(options.engines);
    show(
        output, console, [&](const auto& progress) { return run(options, progress); }, print, as_json);
  };
  if (study == "points")
    return show_of_engines(arguments.points, run_point_study, print_point_study, point_study_as_json);
  if (study == "margin")
    return show_of_engines(arguments.margin, run_margin_study, print_margin_study, margin_study_as_json);
  FlightStudyOptions options = given_to(arguments.flight, given);
  options.draw.seed = given.seed;
  options.engines = arguments.fleet.value_or(options.engines);
  const auto scheduled = scheduled_of(arguments.schedule, options.step_s);
  show(
      output, console, [&](const auto& progress) { return run_flight_study(options, scheduled, progress); },
      print_flight_study, flight_study_as_json);
}

}  // namespace ehm::tuner_design
