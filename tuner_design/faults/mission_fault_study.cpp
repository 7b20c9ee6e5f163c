// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/faults/mission_fault_study.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "deploy/runtime/long_work/parallel_for.h"
#include "tuner_design/faults/fault_study.h"

namespace ehm::tuner_design {
namespace {

constexpr std::uint64_t healthy_from = 1u << 30;  ///< index of the first engine with nothing broken

void count(const SlotOutcome& of, MissionFaultRow& row) {
  const FaultOutcome& outcome = of.outcome;
  ++row.flown;
  if (outcome.delay_s) {
    ++row.detected;
    row.in_time += *outcome.delay_s <= abrupt_limit_s;
    row.detect_s += *outcome.delay_s;
  }
  if (is_right(of.slot.what, outcome)) {
    ++row.right;
    row.diagnose_s += outcome.named_s.value_or(0.0);
    return;
  }
  row.wrong_sensor += outcome.answer == Answer::sensor || outcome.answer == Answer::slow_bias;
  row.component += outcome.answer == Answer::component;
  row.ambiguous += outcome.answer == Answer::ambiguous;
}

void take_means(MissionFaultRow& row) {
  if (row.detected > 0) row.detect_s /= static_cast<double>(row.detected);
  if (row.right > 0) row.diagnose_s /= static_cast<double>(row.right);
}

void add_rows(MissionFaultStudy& study, const std::vector<MissionOutcome>& flights) {
  for (std::size_t moment = 0; moment < moment_names.size(); ++moment)
    for (const FaultRow& what : fault_table()) {
      MissionFaultRow row;
      row.row = &what;
      row.moment = static_cast<Moment>(moment);
      for (const MissionOutcome& flight : flights)
        for (const SlotOutcome& slot : flight.slots)
          if (slot.slot.what.row == &what && slot.slot.moment == row.moment && slot.outcome.flown) count(slot, row);
      take_means(row);
      if (row.flown > 0) study.rows.push_back(row);
    }
}

void add_flights(MissionFaultStudy& study, const std::vector<MissionOutcome>& flights) {
  double samples = 0.0, estimated = 0.0, judged = 0.0, covered = 0.0, landed = 0.0;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const MissionOutcome& flight = flights[i];
    const bool healthy = i >= study.options.flights;
    if (!flight.why.empty()) study.failed.push_back("flight " + std::to_string(i) + ": " + flight.why);
    for (const SlotOutcome& slot : flight.slots) study.not_in_use += !slot.outcome.flown;
    (healthy ? study.fault_free_hours : study.between_hours) += flight.flown_s / 3600.0;
    (healthy ? study.false_alarms : study.alarms_between) += flight.false_alarms;
    if (!healthy || !flight.why.empty()) continue;
    ++landed;
    samples += flight.samples;
    estimated += flight.estimated;
    judged += static_cast<double>(flight.judged);
    covered += static_cast<double>(flight.covered);
    study.ssee_landing += flight.ssee_landing;
    study.claim_landing += flight.claim_landing;
  }
  if (landed == 0.0) return;
  study.estimated = estimated / samples;
  study.coverage = covered / judged;
  study.ssee_landing /= landed;
  study.claim_landing /= landed;
}

}  // namespace

std::array<double, 2> Share::interval() const {
  if (whole == 0) return {0.0, 1.0};
  constexpr double z = 1.959964;
  const auto n = static_cast<double>(whole);
  const double p = value(), middle = p + z * z / (2.0 * n);
  const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  const double size = 1.0 + z * z / n;  // at 0 and 1 the bounds are exact but for rounding
  return {std::max(0.0, (middle - half) / size), std::min(1.0, (middle + half) / size)};
}

MissionFaultRow sum_of(const MissionFaultStudy& study, const std::function<bool(const MissionFaultRow&)>& belongs) {
  MissionFaultRow sum;
  for (const MissionFaultRow& row : study.rows) {
    if (!belongs(row)) continue;
    sum.flown += row.flown;
    sum.in_time += row.in_time;
    sum.detected += row.detected;
    sum.right += row.right;
    sum.wrong_sensor += row.wrong_sensor;
    sum.component += row.component;
    sum.ambiguous += row.ambiguous;
    sum.detect_s += row.detect_s * static_cast<double>(row.detected);
    sum.diagnose_s += row.diagnose_s * static_cast<double>(row.right);
  }
  take_means(sum);
  return sum;
}

MissionFaultStudy run_mission_fault_study(const design::Design& design, const MissionFaultOptions& options,
                                          const std::function<void(double share)>& progress) {
  monitor::CycleOptions cycle;
  cycle.estimator.published = options.estimator;
  cycle.estimator.engine = options.engine_name;
  StudyEngine engine = study_engine(design, options.engine);
  engine.prepared = monitor::PreparedDesign(engine.prepared.design, cycle);
  MissionDraw draw;
  draw.seed = options.seed;
  draw.mismatch = {.build = true, .soak = true, .inputs = true};

  MissionFaultStudy study;
  study.options = options;
  study.sample_time_s = design.model.sample_time_s;
  std::vector<MissionOutcome> flights(options.flights + options.fault_free);
  long_work::parallel_for(
      flights.size(), options.threads,
      [&](std::size_t i) {
        const bool breaks = i < options.flights;
        const std::uint64_t index = breaks ? i : healthy_from + i - options.flights;
        const auto slots = breaks ? mission_slots(design.model.sensors.size(), design.model.health.size(), index)
                                  : std::vector<MissionSlot>{};
        flights[i] = fly_mission(engine, slots, cycle, draw, index);
      },
      [&](std::size_t done) { progress(static_cast<double>(done) / static_cast<double>(flights.size())); });
  add_rows(study, flights);
  add_flights(study, flights);
  flights.resize(options.flights);
  study.flights = std::move(flights);
  return study;
}

}  // namespace ehm::tuner_design
