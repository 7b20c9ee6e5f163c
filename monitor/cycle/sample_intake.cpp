// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/sample_intake.h"

namespace ehm::monitor {

SampleIntake::SampleIntake(const CycleOptions& options, const linear_model::LinearModel& model)
    : sample_check_(options.checks, static_cast<int>(model.sensors.size()), static_cast<int>(model.controls.size()),
                    model.sample_time_s),
      sample_time_(model.sample_time_s),
      stamp_watch_(model.sample_time_s),
      sequence_watch_(model.sample_time_s),
      second_source_(model.sample_time_s),
      condition_check_(options.checks, model) {}

SampleDecision SampleIntake::decide(const Sample& sample, CycleCounters& counters, EventList& events) noexcept {
  const SampleDecision decision = sample_check_.decide(sample);
  counters.lost += decision.lost;
  dropped_ |= 1u << static_cast<unsigned>(decision.verdict);
  switch (decision.verdict) {
    case SampleVerdict::malformed:
      ++counters.malformed;
      break;
    case SampleVerdict::duplicate:
      ++counters.duplicated;
      sequence_watch_.repeated(sample, events);
      break;
    case SampleVerdict::reordered:
      ++counters.reordered;
      break;
    case SampleVerdict::foreign:
      ++counters.foreign;
      second_source_.foreign(sample, sample_check_.source_id(), events);
      break;
    case SampleVerdict::restarted:
    case SampleVerdict::first:
    case SampleVerdict::accepted:
      break;
  }
  return decision;
}

void SampleIntake::take(const Sample& sample, const SampleDecision& decision, CycleCounters& counters,
                        EventList& events) noexcept {
  input_lost_.set(false, {.kind = idl::EventKind::input_lost}, events);
  second_source_.followed(decision.steps, events);
  sequence_watch_.in_order(sample, events);
  stamp_watch_.check(decision, events);
  dropped_ = 0;
  mended_ = sample;
  words_good_ = condition_check_.mend(mended_, decision.steps, events);
  counters.sensor_rejections += condition_check_.replaced();
}

void SampleIntake::lost(double age_s, double limit_s, EventList& events) noexcept {
  input_lost_.set(true,
                  {.kind = idl::EventKind::input_lost,
                   .value = age_s,
                   .threshold = limit_s,
                   .detail = sequence_stands() ? 0 : dropped_},
                  events);
  sample_check_.release_source();
  if (!sample_check_.only_one()) second_source_.end(events);
}

void SampleIntake::reset(EventList& events) noexcept {
  sequence_watch_.end(events);
  stamp_watch_.end(events);
  sample_check_.reset();
}

void SampleIntake::retire(EventList& events) noexcept {
  sample_time_.end_with_design(events);
  second_source_.end(events);
  input_lost_.end_with_design(idl::EventKind::input_lost, 0, events);
}

}  // namespace ehm::monitor
