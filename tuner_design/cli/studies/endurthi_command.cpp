// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/endurthi_command.h"

#include <ostream>

#include "deploy/runtime/files/atomic_file.h"
#include "tuner_design/print/studies/endurthi_health_text.h"
#include "tuner_design/print/studies/endurthi_linear_text.h"
#include "tuner_design/print/studies/endurthi_ukf_text.h"

namespace ehm::tuner_design {
namespace {

using namespace endurthi;

LinearisationStudy linear_study(const EndurthiArguments&, const StudyGiven& given, long_work::ProgressBar& bar) {
  return run_linearisation_study({given.engine, given.threads}, [&](double share) { bar.show_share(share); });
}

HealthStudy health_study(const EndurthiArguments& arguments, const StudyGiven& given, long_work::ProgressBar& bar) {
  HealthStudyOptions options = arguments.health;
  options.engine = given.engine;
  options.seed = given.seed;
  options.threads = given.threads;
  return run_health_study(options, [&](double share) { bar.show_share(share); });
}

/// Runs beside a progress bar, then writes the file, then prints table number `table`.
template <class Study>
void show(int table, Study (*run)(const EndurthiArguments&, const StudyGiven&, long_work::ProgressBar&),
          std::string (*as_csv)(const Study&), nlohmann::ordered_json (*as_json)(const Study&),
          void (*print)(const Study&, int, std::ostream&), const EndurthiArguments& arguments, const StudyGiven& given,
          const std::string& csv, const OutputOptions& output, const Console& console) {
  const Study study = [&] {
    long_work::ProgressBar bar = progress_bar(console, output, long_work::ProgressBar::shares);
    return run(arguments, given, bar);
  }();
  if (!csv.empty()) files::write_file_atomically(csv, as_csv(study));
  print_result(
      console, output, [&] { return as_json(study); }, [&](std::ostream& out) { print(study, table, out); });
}

void ukf_study(const std::string& study, const EndurthiArguments& arguments, const StudyGiven& given,
               const std::string& csv, const OutputOptions& output, const Console& console) {
  if (!csv.empty()) throw CLI::ValidationError("--csv", "does not go with " + study + "; --json has every number");
  if (study == "endurthi-ukf-pendulum") {
    const auto pendulum = run_pendulum_study({.seed = given.seed});
    return print_result(
        console, output, [&] { return pendulum_study_as_json(pendulum); },
        [&](std::ostream& out) { print_pendulum_study(pendulum, out); });
  }
  HealthStudyOptions options = arguments.health;
  options.engine = given.engine;
  options.seed = given.seed;
  options.threads = given.threads;
  const auto turbofan = run_ukf_turbofan(options);
  print_result(
      console, output, [&] { return ukf_turbofan_as_json(turbofan); },
      [&](std::ostream& out) { print_ukf_turbofan(turbofan, out); });
}

}  // namespace

bool is_endurthi_study(const std::string& study) {
  return study.starts_with("endurthi-");
}

void add_endurthi_options(CLI::App& command, EndurthiArguments& arguments) {
  HealthStudyOptions& o = arguments.health;
  command
      .add_option("--p0", o.filter.p0_percent,
                  "endurthi-4, -5: standard deviation of each state and health parameter at the start, percent")
      ->check(CLI::Range(1e-4, 10.0))
      ->capture_default_str();
  command
      .add_option("--wear-noise", o.filter.qh_percent2,
                  "endurthi-4, -5: process noise of health, percent^2 a sample of 0.1 s")
      ->check(CLI::Range(1e-12, 1.0))
      ->capture_default_str();
  command
      .add_option("--cycles-per-flight", o.cycles_per_flight,
                  "endurthi-4, -5: of wear; the table of wear ends at 6000, a long run has 500 flights")
      ->check(CLI::Range(0.1, 12.0))
      ->capture_default_str();
}

void endurthi_study(const std::string& study, const EndurthiArguments& arguments, const StudyGiven& given,
                    const std::string& csv, const OutputOptions& output, const Console& console) {
  if (study == "endurthi-ukf-pendulum" || study == "endurthi-ukf-turbofan")
    return ukf_study(study, arguments, given, csv, output, console);
  const int table = study.back() - '0';
  if (table <= 3)
    return show(table, linear_study, linearisation_study_csv, linearisation_study_as_json, print_linearisation_study,
                arguments, given, csv, output, console);
  show(table, health_study, health_study_csv, health_study_as_json, print_health_study, arguments, given, csv, output,
       console);
}

}  // namespace ehm::tuner_design
