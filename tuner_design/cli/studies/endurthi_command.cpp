// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/endurthi_command.h"

#include <ostream>

#include "tuner_design/print/studies/endurthi_health_text.h"
#include "tuner_design/print/studies/endurthi_linear_text.h"
#include "tuner_design/print/studies/endurthi_ukf_text.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design {
namespace {

using namespace endurthi;

HealthStudyOptions options_of(const EndurthiArguments& arguments, const StudyGiven& given) {
  HealthStudyOptions options = arguments.health;
  options.engine = given.engine;
  options.seed = given.seed;
  options.threads = given.threads;
  return options;
}

int table_of(const std::string& name) {
  return name.back() - '0';
}

}  // namespace

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

StudyOutcome endurthi_linear_study(const std::string& name, const StudyGiven& given, const StudyProgress& progress) {
  const auto print = [table = table_of(name)](const LinearisationStudy& study, std::ostream& out) {
    print_linearisation_study(study, table, out);
  };
  return outcome_of(run_linearisation_study({given.engine, given.threads}, progress),
                    {print, linearisation_study_as_json, linearisation_study_csv, report::linearisation_section});
}

StudyOutcome endurthi_health_study(const std::string& name, const EndurthiArguments& arguments, const StudyGiven& given,
                                   const StudyProgress& progress) {
  const auto print = [table = table_of(name)](const HealthStudy& study, std::ostream& out) {
    print_health_study(study, table, out);
  };
  return outcome_of(run_health_study(options_of(arguments, given), progress),
                    {print, health_study_as_json, health_study_csv, report::health_section});
}

StudyOutcome endurthi_pendulum_study(const StudyGiven& given) {
  return outcome_of(run_pendulum_study({.seed = given.seed}),
                    {print_pendulum_study, pendulum_study_as_json, {}, report::pendulum_section});
}

StudyOutcome endurthi_turbofan_study(const EndurthiArguments& arguments, const StudyGiven& given) {
  return outcome_of(run_ukf_turbofan(options_of(arguments, given)),
                    {print_ukf_turbofan, ukf_turbofan_as_json, {}, report::turbofan_section});
}

}  // namespace ehm::tuner_design
