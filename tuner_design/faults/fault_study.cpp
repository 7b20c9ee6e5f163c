// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/faults/fault_study.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

constexpr double healthy_flight_s = 600.0;
constexpr std::uint64_t healthy_from = 1u << 30;  ///< index of the first engine with nothing broken

void count(const FaultCase& what, const FaultOutcome& outcome, FaultRowSummary& summary) {
  ++summary.flown;
  summary.found_in_time += outcome.delay_s.has_value() && *outcome.delay_s <= abrupt_limit_s;
  if (is_right(what, outcome)) {
    ++summary.right;
    return;
  }
  summary.wrong_sensor += outcome.answer == Answer::sensor;
  summary.component += outcome.answer == Answer::component;
  summary.ambiguous += outcome.answer == Answer::ambiguous;
  summary.slow_bias += outcome.answer == Answer::slow_bias;
  summary.silent += outcome.answer == Answer::nothing;
}

FaultRowSummary summary_of(const FaultRow& row, const FaultStudy& study) {
  FaultRowSummary summary;
  summary.row = &row;
  std::vector<double> delays;
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const FaultOutcome& outcome = study.outcomes[i];
    if (study.cases[i].row != &row || !outcome.flown) continue;
    count(study.cases[i], outcome, summary);
    if (outcome.delay_s) delays.push_back(*outcome.delay_s);
  }
  if (delays.empty()) return summary;
  const auto middle = delays.begin() + static_cast<std::ptrdiff_t>(delays.size() / 2);
  std::nth_element(delays.begin(), middle, delays.end());
  summary.median_delay_s = *middle;
  return summary;
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

void sum_up(FaultStudy& study) {
  for (const FaultRow& row : fault_table()) study.rows.push_back(summary_of(row, study));
  for (const FaultOutcome& outcome : study.outcomes) {
    study.not_flown += !outcome.flown;
    study.largest_step_sigmas = std::max(study.largest_step_sigmas, outcome.largest_step_sigmas);
  }
  for (std::size_t i = 0; i < study.cases.size(); ++i) study.early_alarms += as_size(study.outcomes[i].false_alarms);
  FaultRowSummary five, component;
  for (const FaultRowSummary& s : study.rows) {
    if (s.row->broken == Broken::component) component = s;
    if (s.row->broken != Broken::bias || std::abs(s.row->size) != 5.0) continue;
    five.flown += s.flown;
    five.found_in_time += s.found_in_time;
    five.right += s.right;
    five.ambiguous += s.ambiguous;
  }
  study.found = share(five.found_in_time, five.flown);
  study.right_sensor = share(five.right, five.flown);
  study.ambiguous_of_rest = share(five.ambiguous, five.flown - five.right);
  study.component_not_sensor = 1.0 - share(component.wrong_sensor, std::max<std::size_t>(1, component.flown));
}

}  // namespace

FaultStudy run_fault_study(const design::Design& design, const FaultStudyOptions& options,
                           const std::function<void(double share)>& progress) {
  const StudyEngine engine = study_engine(design, options.engine);
  const std::vector<FaultCase> round = round_of_cases(design.model.sensors.size(), design.model.health.size());
  FaultStudy study;
  study.sensors = names_of(design.model.sensors);
  study.health = names_of(design.model.health);
  for (std::size_t c = 0; c < options.cases; ++c) study.cases.push_back(round[c % round.size()]);
  study.outcomes.resize(options.cases);

  const auto flights = static_cast<std::size_t>(std::ceil(3600.0 * options.hours / healthy_flight_s));
  std::vector<FaultOutcome> healthy(flights);
  const std::size_t all = options.cases + flights;
  long_work::parallel_for(
      all, options.threads,
      [&](std::size_t i) {
        if (i < options.cases)
          study.outcomes[i] = fly_case(engine, study.cases[i], options.seed, i);
        else
          healthy[i - options.cases] =
              fly_healthy(engine, healthy_flight_s, options.seed, healthy_from + i - options.cases);
      },
      [&](std::size_t done) { progress(static_cast<double>(done) / static_cast<double>(all)); });

  sum_up(study);
  for (const FaultOutcome& outcome : healthy) {
    study.not_flown += !outcome.flown;
    if (!outcome.flown) continue;
    study.fault_free_hours += healthy_flight_s / 3600.0;
    study.false_alarms += as_size(outcome.false_alarms);
  }
  return study;
}

}  // namespace ehm::tuner_design
