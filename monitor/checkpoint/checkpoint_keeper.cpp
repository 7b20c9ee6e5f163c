// SPDX-License-Identifier: Apache-2.0
#include "monitor/checkpoint/checkpoint_keeper.h"

#include <algorithm>
#include <thread>

#include "monitor/realtime/clock.h"

namespace ehm::monitor {

CheckpointKeeper::CheckpointKeeper(CheckpointWriter& writer, const ResumeTable& resumable, double period_s,
                                   double max_age_s, std::size_t companions)
    : writer_(writer),
      resumable_(resumable),
      period_ns_(static_cast<std::int64_t>(1e9 * period_s)),
      max_age_s_(max_age_s) {
  request_.state.companions.resize(companions);
}

std::optional<Event> CheckpointKeeper::resume(EngineSlot& slot) const noexcept {
  const Checkpoint* checkpoint = resumable_.find(slot.engine_id);
  if (!checkpoint) return std::nullopt;
  const Resumption verdict = slot.cycle.resume(checkpoint->state, slot.sample, max_age_s_);
  const double gap_s =
      continuation(checkpoint->state, slot.sample, slot.cycle.design().model.sample_time_s, max_age_s_).gap_s;
  return Event{.kind = idl::EventKind::checkpoint,
               .raised = !went_on(verdict),
               .value = gap_s,
               .threshold = max_age_s_,
               .detail = static_cast<std::uint32_t>(verdict)};
}

void CheckpointKeeper::keep(EngineSlot& slot, std::int64_t now_ns) noexcept {
  if (now_ns == turn_ns_ || now_ns - slot.checkpoint_ns < period_ns_ || !writer_.has_room()) return;
  if (!take(slot)) return;
  slot.checkpoint_ns = now_ns;
  turn_ns_ = now_ns;
}

void CheckpointKeeper::keep_last(EngineSlot& slot, std::int64_t limit_ns) {
  while (!writer_.has_room() && monotonic_ns() < limit_ns) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (writer_.has_room()) take(slot);
}

bool CheckpointKeeper::take(EngineSlot& slot) noexcept {
  // Nothing new since the last one: an engine that has fallen silent keeps the age of its last sample.
  if (slot.cycle.counters().processed == slot.checkpoint_processed || !slot.cycle.snapshot(request_.state))
    return false;
  slot.checkpoint_processed = slot.cycle.counters().processed;
  request_.engine_id = slot.engine_id;
  const std::string& hash = slot.cycle.design().hash;
  request_.design_hash.fill(' ');
  std::copy_n(hash.begin(), std::min(hash.size(), request_.design_hash.size()), request_.design_hash.begin());
  request_.wall_time_ns = wall_clock_ns();
  writer_.push(request_);
  return true;
}

}  // namespace ehm::monitor
