// SPDX-License-Identifier: Apache-2.0
#include "monitor/service/cycle_thread.h"

#include <algorithm>

#include "deploy/runtime/numbers/index.h"
#include "idl/wire_names.h"
#include "monitor/dds/convert.h"
#include "monitor/realtime/clock.h"
#include "monitor/service/engine_status.h"
#include "monitor/shared/engine_estimators.h"

namespace ehm::monitor {

using idl::StatusLevel;

namespace {
constexpr double longest_wait_s = 0.015;  // how soon a loss of input is noticed
constexpr double leaving_wait_s = 0.002;  // while the pause between two samples is looked for
// The engines are looked through so often, not at each sample: with N engines that would be N^2 looks a sample time.
constexpr std::int64_t watch_period_ns = 5'000'000;
constexpr int most_samples_a_turn = 1024;  // so that an overload starves neither commands nor the watch
constexpr std::size_t most_waiting = 1024;
constexpr int most_statuses_a_watch = 16;  // a thousand engines' are spread over 0.3 s
// Under monitor.clock = "source" time may run fast, slow or in the past, so that an age in our own time means nothing;
// a source that says nothing at all for so long is lost all the same.
constexpr double source_silence_s = 2.0;
constexpr std::int64_t malformed_period_ns = 1'000'000'000;
}  // namespace

CycleThread::CycleThread(idl::Participant& participant, const MonitorConfig& config, EngineTable& engines,
                         const CycleLinks& links)
    : source_id_(static_cast<std::uint32_t>(config.source_id)),
      source_clock_(config.clock == "source"),
      status_period_ns_(static_cast<std::int64_t>(1e9 * config.status_period_s)),
      forget_engine_s_(config.forget_engine_s),
      start_ns_(links.start_ns),
      engines_(&engines),
      exchange_(links.exchange),
      reports_(links.reports),
      checkpoints_(links.checkpoints),
      flights_(links.flights),
      records_(links.records),
      turns_(links.turns),
      sensors_(participant),
      commands_(participant),
      descriptions_(participant),
      health_(participant),
      auxiliary_(participant),
      residuals_(participant),
      waiting_(most_waiting) {
  wait_set_.attach_condition(sensors_.condition());
  wait_set_.attach_condition(commands_.condition());
  wait_set_.attach_condition(descriptions_.condition());
  triggered_.reserve(3);
  for (const std::string& name : all_shadow_names(config)) shadows_.emplace_back(participant, name);
  if (participant.options().redundancy.exclusive) peers_ = std::make_unique<PeerWatch>(participant, source_id_);
}

void CycleThread::run_once() {
  const double wait_s = leaving_ ? leaving_wait_s : longest_wait_s;
  // The condition does not trigger again for samples that were left behind.
  if (!backlog_) wait_set_.wait(triggered_, eprosima::fastrtps::Duration_t(static_cast<long double>(wait_s)));
  arrival_.wake_up();
  if (peers_) peers_->awake(monotonic_ns());
  exchange_table();
  hear_descriptions();
  take_samples();
  MonitorCommand command;
  while (commands_.take(command)) obey(command);
  if (const std::int64_t now_ns = monotonic_ns(); now_ns - watched_ns_ >= watch_period_ns) {
    watched_ns_ = now_ns;
    watch_input(now_ns);
  }
  turns_.turned();
}

/// What was estimated before its source said in which units the values are has to be forgotten.
void CycleThread::hear_descriptions() {
  descriptions_.take([&](const SourceKey& key, DescribedSource& source) {
    EngineSlot* slot = engines_->find(key.engine_id);
    if (!slot || slot->participant != key.participant || slot->cycle.intake().source_id() != key.source_id) return;
    const SourceFit before = source.fit;
    source.fit_to(slot->cycle.design().model);
    report_misfits(*slot, source);
    if (source.fit == before) return;
    slot->cycle.reset(RestartReason::described_anew);
    if (records_) records_->marker(*slot, recording::RowKind::described_anew);
    report_events(*slot);
  });
}

void CycleThread::take_samples() {
  if (!waiting_.empty()) {
    const std::int64_t now_ns = monotonic_ns();
    const auto waits = [&](const Arrival& a) {
      return descriptions_.awaited({a.sample.engine_id(), a.sample.source_id(), a.participant}, a.arrival_ns, now_ns);
    };
    waiting_.release(waits, [&](const Arrival& a) { handle(a); });
  }
  int taken = 0;
  for (; taken < most_samples_a_turn && sensors_.take(incoming_.sample); ++taken) {
    incoming_.writer = sensors_.writer();
    incoming_.participant = sensors_.participant();
    incoming_.arrival_ns = arrival_.monotonic_of(sensors_.received_ns());
    if (!must_wait(incoming_)) {
      handle(incoming_);
      continue;
    }
    if (waiting_.full()) waiting_.release([](const Arrival&) { return false; }, [&](const Arrival& a) { handle(a); });
    waiting_.add(incoming_);
  }
  backlog_ = taken == most_samples_a_turn;
}

/// Only the first samples of an engine, or of another source or writer than before, may have to; who would be dropped
/// all the same has not.
bool CycleThread::must_wait(const Arrival& arrival) {
  const std::uint32_t engine_id = arrival.sample.engine_id(), source_id = arrival.sample.source_id();
  if (!waiting_.empty() && waiting_.holds(engine_id, arrival.writer)) return true;
  const EngineSlot* slot = engines_->find(engine_id);
  if (slot && slot->cycle.counters().received > 0 &&
      (slot->cycle.intake().foreign(source_id, arrival.writer) ||
       (slot->cycle.intake().source_id() == source_id && slot->participant == arrival.participant)))
    return false;
  return descriptions_.awaited({engine_id, source_id, arrival.participant}, arrival.arrival_ns, monotonic_ns());
}

void CycleThread::handle(const Arrival& arrival) {
  const EngineSensors& sensors = arrival.sample;
  turns_.turned();
  EngineSlot* slot = engines_->find(sensors.engine_id());
  if (!slot) slot = admit(sensors);
  if (!slot) return;
  convert(sensors, slot->sample);
  slot->sample.writer = arrival.writer;
  fit_source(*slot, arrival.participant);
  const std::uint64_t malformed = slot->cycle.counters().malformed;
  if (slot->cycle.counters().received == 0) first_sample(*slot);
  const bool accepted = slot->cycle.estimate(slot->sample);
  if (accepted || slot->cycle.intake().sequence_stands()) slot->heard_ns = arrival.arrival_ns;
  if (accepted) {
    slot->received_ns = arrival.arrival_ns;
    slot->participant = arrival.participant;
    slot->last_sequence = slot->sample.sequence;
    publish(*slot, arrival.arrival_ns);
  }
  if (records_) records_->sample(*slot, accepted);
  if (accepted) keep_budget(*slot);
  if (accepted) flights_.follow(*slot);
  report_events(*slot);
  if (slot->cycle.counters().malformed != malformed) report_malformed(*slot);
}

/// Who takes too long rests; a replay has no clock, and reads it in the recording.
void CycleThread::keep_budget(EngineSlot& slot) {
  const double budget_ms = slot.cycle.options().estimator.budget_ms;
  const CompanionEstimators& companions = slot.cycle.companions();
  for (std::size_t i = 0; i < companions.size(); ++i) {
    const std::int64_t took_ns = companions.lap_ns(i);
    if (!slot.budget.look(i, took_ns, budget_ms)) continue;
    slot.cycle.rest(i, 1e-3 * static_cast<double>(took_ns), 1e3 * budget_ms);
    if (records_) records_->marker(slot, recording::RowKind::rested, idl::estimator_number(companions.tally(i).name));
  }
}

/// A filter for an engine that has none; null if it gets none.
EngineSlot* CycleThread::admit(const EngineSensors& sensors) {
  convert(sensors, stray_);
  if (EngineSlot* slot = engines_->join(sensors.engine_id(), stray_)) return slot;
  // Said once a thousand: a stray source must not fill the log.
  if (unknown_engine_samples_++ % 1000 != 0) return nullptr;
  const EngineSlot* spare = engines_->spare();
  const bool unusable = spare && sensors.engine_id() != 0;
  CycleReport report{.kind = unusable ? CycleReport::Kind::malformed : CycleReport::Kind::unknown_engine,
                     .engine_id = sensors.engine_id(),
                     .design = unusable ? &spare->cycle.design() : nullptr,
                     .sequence = unknown_engine_samples_};
  report.malformed = {stray_.source_id, stray_.schema, stray_.sensor_count, stray_.actuator_count,
                      unknown_engine_samples_};
  reports_.push(report);
  return nullptr;
}

/// The slot's sample in the design's units.
void CycleThread::fit_source(EngineSlot& slot, std::uint64_t participant) {
  DescribedSource* source = descriptions_.find({slot.engine_id, slot.sample.source_id, participant});
  if (!source) return;
  if (const auto& model = slot.cycle.design().model; source->model != &model) {
    source->fit_to(model);
    report_misfits(slot, *source);
  }
  source->fit.apply(slot.sample);
}

void CycleThread::report_misfits(const EngineSlot& slot, DescribedSource& source) {
  SourceChannel first_converted{slot.sample.source_id, 0, Misfit::none, false, 0, {}};
  const auto compare = [&](std::size_t channel, const ChannelFit& fit, const DescribedChannel& said) {
    const std::uint32_t bit = 1u << channel;
    const bool misfits = fit.misfit != Misfit::none;
    if (fit.used() && fit.conversion.changes() && first_converted.converted++ == 0) {
      first_converted.channel = static_cast<std::uint32_t>(channel);
      first_converted.said = said;
    }
    if (misfits == ((source.told & bit) != 0)) return;
    source.told ^= bit;
    report_channel(slot, {slot.sample.source_id, static_cast<std::uint32_t>(channel), fit.misfit, misfits, 0, said});
  };
  const auto& model = slot.cycle.design().model;
  for (std::size_t i = 0; i < source.sensors_of(model); ++i) compare(i, source.fit.sensors[i], source.sensors[i]);
  for (std::size_t i = 0; i < source.actuators_of(model); ++i)
    compare(estimation::max_sensors + i, source.fit.actuators[i], source.actuators[i]);
  compare(SourceChannel::engine_type, {source.other_engine(model) ? Misfit::name : Misfit::none, {}},
          source.engine_type);
  if (first_converted.converted > 0) report_channel(slot, first_converted);
}

void CycleThread::report_channel(const EngineSlot& slot, const SourceChannel& channel) {
  CycleReport report{.kind = CycleReport::Kind::source_channel,
                     .engine_id = slot.engine_id,
                     .design = &slot.cycle.design(),
                     .sequence = slot.sample.sequence,
                     .source_time_ns = slot.sample.source_time_ns};
  report.source_channel = channel;
  reports_.push(report);
}

void CycleThread::first_sample(EngineSlot& slot) {
  reports_.push({.kind = CycleReport::Kind::new_engine, .engine_id = slot.engine_id, .design = &slot.cycle.design()});
  const auto event = checkpoints_ ? checkpoints_->resume(slot) : std::nullopt;
  if (event) report_event(slot, *event);
  // An estimator that its checkpoint has left cold goes on from its last flight.
  const bool goes_on = event && !event->raised && slot.cycle.published_went_on();
  const bool known = flights_.begin(slot, goes_on);
  if (records_ && (known || (event && !event->raised))) records_->marker(slot, recording::RowKind::resumed);
}

/// EngineHealth first: judging the sample, and the rest of what is published, can wait.
void CycleThread::publish(EngineSlot& slot, std::int64_t arrival_ns) {
  const CycleResult& result = slot.cycle.result();
  const Stamp stamp{slot.engine_id, source_id_, slot.sample.sequence, slot.sample.source_time_ns, wall_clock_ns()};
  if (result.estimates) {
    convert(result.estimate, result.flags, stamp, health_sample_);
    if (send(slot, health_, health_sample_)) {
      const double latency_us = std::max(0.0, 1e-3 * static_cast<double>(monotonic_ns() - arrival_ns));
      slot.latency.record(latency_us);
      slot.deadline_misses += latency_us > 1e6 * slot.cycle.design().model.sample_time_s;
    }
  }
  slot.cycle.diagnose();
  if (result.estimates) {
    convert(result.estimate, result.flags, stamp, auxiliary_sample_);
    send(slot, auxiliary_, auxiliary_sample_);
    publish_shadows(slot, stamp);
  }
  convert(result, stamp, residuals_sample_);
  send(slot, residuals_, residuals_sample_);
}

void CycleThread::publish_shadows(EngineSlot& slot, const Stamp& stamp) {
  const CycleResult& result = slot.cycle.result();
  for (std::size_t i = 0; i < result.shadow.size(); ++i) {
    if (!result.shadow[i].holds) continue;
    ShadowWriters& writers = shadows_[as_size(slot.shadow_place[i])];
    convert(result.shadow[i], result.flags, stamp, health_sample_);
    send(slot, writers.health, health_sample_);
    convert(result.shadow[i], result.flags, stamp, auxiliary_sample_);
    send(slot, writers.auxiliary, auxiliary_sample_);
  }
}

template <class T>
bool CycleThread::send(EngineSlot& slot, RankedWriter<T>& writer, const T& sample) {
  if (slot.released || (peers_ && !peers_->may_write(monotonic_ns()))) return false;
  slot.writes_refused += !writer.write(sample, incumbent());
  return true;
}

void CycleThread::watch_input(std::int64_t now_ns) {
  int statuses = 0;
  EventList changes;
  engines_->for_each([&](EngineSlot& slot) {
    const std::int64_t last_ns = slot.heard_ns != 0 ? slot.heard_ns : start_ns_;
    const double age_s = 1e-9 * static_cast<double>(now_ns - last_ns);
    if (!source_clock_ || age_s > source_silence_s) {
      if (slot.cycle.no_input(age_s) && records_) records_->input_lost(slot, now_ns - last_ns);
      report_events(slot);
    }
    if (forget_engine_s_ > 0.0 && age_s > forget_engine_s_ && engines_->may_leave(slot) && reports_.has_room())
      return leave(slot, age_s);
    slot.resets.look(now_ns, changes);
    for (const Event& event : changes) report_event(slot, event);
    changes.clear();
    const StatusLevel level = level_of(slot);
    const bool due =
        now_ns - slot.status_ns >= status_period_ns_ || static_cast<std::uint32_t>(level) != slot.status_level;
    if (due && statuses++ < most_statuses_a_watch) report_status(slot, level, now_ns);
    if (checkpoints_) checkpoints_->keep(slot, now_ns);
    flights_.hand_over(slot);
  });
}

void CycleThread::report_event(const EngineSlot& slot, const Event& event) {
  reports_.push({.kind = CycleReport::Kind::event,
                 .engine_id = slot.engine_id,
                 .design = &slot.cycle.design(),
                 .event = event,
                 .sequence = slot.sample.sequence,
                 .source_time_ns = slot.sample.source_time_ns});
}

void CycleThread::report_events(EngineSlot& slot) {
  for (const Event& event : slot.cycle.events()) report_event(slot, event);
  slot.cycle.clear_events();
}

void CycleThread::report_malformed(EngineSlot& slot) {
  // Said once a second: a broken source must not fill the log.
  const std::int64_t now_ns = monotonic_ns();
  if (slot.malformed_ns != 0 && now_ns - slot.malformed_ns < malformed_period_ns) return;
  slot.malformed_ns = now_ns;
  const Sample& s = slot.sample;
  CycleReport report{.kind = CycleReport::Kind::malformed, .engine_id = slot.engine_id, .design = &slot.cycle.design()};
  report.malformed = {s.source_id, s.schema, s.sensor_count, s.actuator_count, slot.cycle.counters().malformed};
  reports_.push(report);
}

void CycleThread::report_status(EngineSlot& slot, StatusLevel level, std::int64_t now_ns) {
  if (!reports_.has_room()) return;  // tried again at the next turn
  if (records_) check_recording(slot);
  CycleReport report{.kind = CycleReport::Kind::status, .engine_id = slot.engine_id, .design = &slot.cycle.design()};
  report.status = make_status(slot, level, now_ns, start_ns_);
  report.estimates = estimates_of(slot.cycle);
  report.status.source_id(source_id_);
  report.status.status_time_ns(wall_clock_ns());
  report.status.unknown_engine_samples(unknown_engine_samples_);
  report.status.reports_lost(reports_.overflow());
  report.status.records_lost(records_ ? records_->lost() : 0);
  report.status.reloads(exchange_.reloads.load(std::memory_order_relaxed));
  report.status.reloads_refused(exchange_.refused.load(std::memory_order_relaxed));
  if (checkpoints_) {
    report.status.checkpoints_written(checkpoints_->writer().written());
    report.status.checkpoints_failed(checkpoints_->writer().failed());
  }
  reports_.push(report);
  slot.status_ns = now_ns;
  // A change of level makes two statuses close together; the rate is that of half a period at least.
  if (now_ns - slot.rate_ns >= status_period_ns_ / 2) {
    slot.rate_ns = now_ns;
    slot.rate_received = slot.cycle.counters().received;
  }
  slot.status_level = static_cast<std::uint32_t>(level);
  slot.status_counters = slot.cycle.counters();
}

void CycleThread::check_recording(EngineSlot& slot) {
  const std::uint64_t lost = records_->lost();
  EventList changes;
  slot.losing_records.set(lost != slot.status_records_lost,
                          {.kind = idl::EventKind::recording, .value = static_cast<double>(lost)}, changes);
  slot.status_records_lost = lost;
  for (const Event& event : changes) report_event(slot, event);
}

void CycleThread::exchange_table() {
  EngineTable* next = exchange_.next.exchange(nullptr, std::memory_order_acquire);
  if (!next) return;
  next->take_over(*engines_, [&](EngineSlot& old, EngineSlot& now) {
    old.cycle.retire();
    report_events(old);
    flights_.begin(now, false);
    reports_.push({.kind = CycleReport::Kind::new_engine, .engine_id = now.engine_id, .design = &now.cycle.design()});
    if (records_) records_->marker(now, recording::RowKind::resumed);
  });
  exchange_.retired.store(engines_, std::memory_order_release);
  engines_ = next;
  descriptions_.forget_models();
}

}  // namespace ehm::monitor
