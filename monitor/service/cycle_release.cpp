// SPDX-License-Identifier: Apache-2.0
// The part of the cycle thread that gives engines up: one that has been silent for long, and all of them at a stop.

#include "idl/wire_values.h"
#include "monitor/realtime/clock.h"
#include "monitor/service/cycle_thread.h"

namespace ehm::monitor {

namespace {
constexpr std::int64_t longest_release_ns = 100'000'000;
constexpr double release_drain_s = 0.1;                    // a reader that does not answer is waited for once
constexpr std::int64_t last_checkpoints_ns = 300'000'000;  // of a stop that must be over within a second
}  // namespace

/// What it has raised ends, who reads it learns that it is gone, and its filter is free.
void CycleThread::leave(EngineSlot& slot, double age_s) {
  slot.cycle.retire();
  report_events(slot);
  report_event(slot,
               {.kind = idl::EventKind::engine_left, .raised = true, .value = age_s, .threshold = forget_engine_s_});
  reports_.push({.kind = CycleReport::Kind::engine_left, .engine_id = slot.engine_id, .design = &slot.cycle.design()});
  if (records_) records_->marker(slot, recording::RowKind::left);
  release(slot);
  engines_->leave(slot);
}

/// In the middle of the pause between two samples, when every monitor has written its estimate of the last one; or the
/// engine has fallen silent.
bool CycleThread::between_samples(const EngineSlot& slot, std::int64_t now_ns) {
  const double samples =
      1e-9 * static_cast<double>(now_ns - slot.received_ns) / slot.cycle.design().model.sample_time_s;
  return (samples > 0.3 && samples < 0.7) || samples > 2.0;
}

void CycleThread::release(EngineSlot& slot) {
  health_sample_.engine_id(slot.engine_id);
  auxiliary_sample_.engine_id(slot.engine_id);
  residuals_sample_.engine_id(slot.engine_id);
  health_.release(health_sample_, incumbent());
  auxiliary_.release(auxiliary_sample_, incumbent());
  residuals_.release(residuals_sample_, incumbent());
  for (ShadowWriters& shadow : shadows_) {
    shadow.health.release(health_sample_, incumbent());
    shadow.auxiliary.release(auxiliary_sample_, incumbent());
  }
  slot.released = true;
}

void CycleThread::release_all() {
  const std::int64_t limit_ns = monotonic_ns() + longest_release_ns;
  leaving_ = true;
  // A standby is heard from the sample after the release on: without a gap if that falls between two samples.
  for (bool some_left = true; some_left;) {
    some_left = false;
    const std::int64_t now_ns = monotonic_ns();
    engines_->for_each([&](EngineSlot& slot) {
      if (slot.released) return;
      if (!peers_ || now_ns > limit_ns || between_samples(slot, now_ns))
        release(slot);
      else
        some_left = true;
    });
    if (some_left) run_once();
  }
}

void CycleThread::stop() {
  release_all();
  engines_->for_each([&](EngineSlot& slot) { report_status(slot, idl::StatusLevel::stopped, monotonic_ns()); });
  const std::int64_t limit_ns = monotonic_ns() + last_checkpoints_ns;
  if (checkpoints_) engines_->for_each([&](EngineSlot& slot) { checkpoints_->keep_last(slot, limit_ns); });
  // A writer that is deleted takes along what its readers have not got yet, the end of the estimates among it.
  static_cast<void>(health_.drain(release_drain_s) && auxiliary_.drain(release_drain_s) &&
                    residuals_.drain(release_drain_s));
}

}  // namespace ehm::monitor
