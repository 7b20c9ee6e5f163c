// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/flight_study_command.h"

#include "tuner_design/print/flight_study_text.h"

namespace ehm::tuner_design {

void add_flight_study_options(CLI::App& command, FlightStudyOptions& options) {
  command.add_option("--fleet", options.engines, "flight: engines of each fleet")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000}))
      ->capture_default_str();
  command
      .add_option("--step", options.step_s,
                  "flight: seconds of a sample; a coarser one than 0.015 has less noise, so that a second brings equal "
                  "information")
      ->check(CLI::Range(0.015, 0.1))
      ->capture_default_str();
}

void flight_study(const FlightStudyOptions& options, const OutputOptions& output, const Console& console) {
  long_work::ProgressBar bar = progress_bar(console, output, long_work::ProgressBar::shares);
  const FlightStudy study = run_flight_study(options, [&](double share) { bar.show_share(share); });
  print_result(
      console, output, [&] { return flight_study_as_json(study); },
      [&](std::ostream& out) { print_flight_study(study, out); });
}

}  // namespace ehm::tuner_design
